/** Makes and hands over files: figures, waves as a table, code. Nothing leaves the machine. */
import { figureFile } from "./plots/figures.js";
import { slope } from "./plots/waves.js";

const FREE_S = 10; // until a browser has surely taken the file

/** Offer `content` (Blob or text) as a download. */
export function handOver(name, content, type) {
  const blob = content instanceof Blob ? content : new Blob([content], { type });
  const address = URL.createObjectURL(blob);
  const anchor = Object.assign(document.createElement("a"), { href: address, download: name });
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(address), FREE_S * 1e3);
}

/** `kind`: svg or png. */
export async function keepFigure(figure, kind, ground) {
  const content = await figureFile(figure, kind, ground);
  if (content) handOver(`vocalis-${figure.name}.${kind}`, content, "image/svg+xml");
}

/** The waves of a result as CSV in SI units, one row a sample. Pure. */
export function wavesCsv(result) {
  const { rate, startS, waves } = result;
  const derivative = slope(waves.flow, 0, waves.flow.length - 1, rate);
  const head = "time_s,radiated_pressure_pa,glottal_flow_m3_s,glottal_flow_derivative_m3_s2,glottal_area_m2,contact_pressure_max_pa";
  const rows = Array.from({ length: waves.flow.length }, (_, k) =>
    [(startS + k / rate).toFixed(7), ...[waves.pressure, waves.flow, derivative, waves.area, waves.contact].map((wave) => wave[k].toPrecision(6))].join(","),
  );
  return [head, ...rows, ""].join("\n");
}

/** A Python script that makes the request's voice again. Pure. `request`: the document of params.js. */
export function pythonCode(request) {
  return `import vfcore
from vfcore.spec.document import simulation_from_dict

request = ${pythonLiteral(request)}
result = vfcore.simulate(simulation_from_dict(request))
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
  if (typeof value === "string") return JSON.stringify(value);
  if (typeof value !== "object") return String(value);
  const inner = `${indent}    `;
  const rows = Object.entries(value).map(([key, item]) => `${inner}${JSON.stringify(key)}: ${pythonLiteral(item, inner)},`);
  return rows.length ? `{\n${rows.join("\n")}\n${indent}}` : "{}";
}

/** Measures as tab-separated rows for a sheet: name, symbol, value, unit, published range, source, reason. Pure. */
export function measureRows(catalogue, measures, words) {
  const rows = [...catalogue.values()].map((row) => {
    const measure = measures[row.key];
    const range = row.normal_range ? `${row.normal_range.low} – ${row.normal_range.high}` : "";
    return [row.name, row.symbol, measure?.value ?? "", row.unit, range, row.normal_range?.source ?? "", row.definition, measure?.reason ?? ""];
  });
  return [words, ...rows];
}

export const asTsv = (rows) => rows.map((row) => row.map((cell) => String(cell).replace(/[\t\n]/g, " ")).join("\t")).join("\n");

/** The same rows as an HTML table, which documents take. Pure. */
export function asMarkup(rows) {
  const cell = (text) => `<td>${String(text).replace(/[&<>]/g, (sign) => `&#${sign.charCodeAt(0)};`)}</td>`;
  return `<table>${rows.map((row) => `<tr>${row.map(cell).join("")}</tr>`).join("")}</table>`;
}
