/** A voice in other formats: waves as CSV, the request as Python and as curl. Pure. */
import { slope } from "../waves/stack.js";

/** The waves of a result as CSV in SI units, one row per sample. Pure. */
export function wavesCsv(result) {
  const { rate, startS, waves } = result;
  const derivative = slope(waves.flow, 0, waves.flow.length - 1, rate);
  const head = [
    "time_s",
    "radiated_pressure_pa",
    "glottal_flow_m3_s",
    "glottal_flow_derivative_m3_s2",
    "glottal_area_m2",
    "contact_pressure_max_pa",
  ].join(",");
  const rows = Array.from({ length: waves.flow.length }, (_, k) =>
    [
      (startS + k / rate).toFixed(7),
      ...[waves.pressure, waves.flow, derivative, waves.area, waves.contact].map((wave) => wave[k].toPrecision(6)),
    ].join(","),
  );
  return [head, ...rows, ""].join("\n");
}

/** A Python script that computes the voice of `request`, a nested patch. Pure. */
export function pythonCode(request) {
  return `import vfcore

request = ${pythonLiteral(request)}
result = vfcore.simulate(vfcore.resolve(request))
print(result.report.state)
for key, measure in result.report.measures.items():
    print(key, measure.value, measure.unit)
`;
}

/** The same as a call of this server. Pure. */
export function curlCode(request, address) {
  return `curl --silent --show-error --fail-with-body ${address}simulate \\
  --header 'Content-Type: application/json' \\
  --data '${JSON.stringify(request).replaceAll("'", "\\u0027")}'
`;
}

function pythonLiteral(value, indent = "") {
  if (value === null) return "None";
  if (typeof value === "boolean") return value ? "True" : "False";
  if (typeof value === "string") return JSON.stringify(value);
  if (typeof value !== "object") return String(value);
  const inner = `${indent}    `;
  const rows = Object.entries(value).map(
    ([key, item]) => `${inner}${JSON.stringify(key)}: ${pythonLiteral(item, inner)},`,
  );
  return rows.length ? `{\n${rows.join("\n")}\n${indent}}` : "{}";
}
