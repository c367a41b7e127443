/** Texts of the measures. */

/** Large numbers of the strip: measure, label, unit as shown, factor. */
export const HEADLINES = [
  { key: "fo_hz", label: "Pitch" },
  { key: "spl_30cm_db", label: "Level at 30 cm", also: { key: "spl_lips_db", label: "lips" } },
  { key: "closed_quotient", label: "Closed quotient", decimals: 2 },
  { key: "speed_quotient", label: "Speed quotient" },
  { key: "mean_flow_ml_s", label: "Mean flow" },
  { key: "contact_pressure_max_pa", label: "Contact", unit: "kPa", factor: 1e-3, decimals: 2 },
];

export const MEASURE = {
  definition: "Definition",
  formula: "Formula",
  threshold: "Settings",
  signal: "Read from",
  normal: "Expected",
  about: (value) => `about ${value}`,
  fromTo: (low, high) => `${low} to ${high}`,
  usual: (range) => `usual ${range}`,
  source: "Source",
  noRange: "No published range for this measure.",
  cycles: (n) => (n ? `Mean over ${n} cycles of the last half of the run.` : "From the last half of the run."),
  caution: "With the paper’s constants, flow and level are well above human values; read trends and shapes.",
  open: (name) => `${name}: definition, expected values, source`,
  table: "All measures",
  columns: ["Measure", "Value", "Published"],
};

export const COPY_TABLE = {
  copy: "Copy as table",
  columns: ["Measure", "Symbol", "Value", "Unit", "Published range", "Source", "Definition", "Why there is no value"],
  copied: "Copied: paste it into a sheet or a document.",
  failed: "This browser does not let the page copy.",
};

/** What would help when nothing vibrates, from the values set and the gap between the vocal processes, mm. */
export function hintFor(values, gapMm) {
  const pressure = values.subglottal_pressure_pa;
  const apart = gapMm > 1;
  const advice = [];
  if (apart && values["activation.pca"] > 0.05) advice.push("less PCA");
  if (apart && Math.min(values["activation.lca"], values["activation.ia"]) < 0.6) advice.push("more LCA and IA");
  if (pressure < 600) advice.push("more lung pressure");
  if (!apart && values["activation.ta"] > 0.6) advice.push("less TA");
  if (!apart && values["activation.ct"] > 0.7) advice.push("less CT");
  if (!advice.length) advice.push(apart ? "a posture closer to the midline" : "another lung pressure");
  const cause = apart ? `The vocal processes are ${gapMm.toFixed(1)} mm apart. ` : "";
  return `${cause}Try ${advice.join(", ").replace(/, ([^,]*)$/, " or $1")}.`;
}
