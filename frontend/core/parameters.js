/** The server's parameter schema as the page uses it; conversion between values and request documents. */

const MUSCLE = /^(.*) \(([A-Z]+)\)$/;
const GIVEN_POSTURE = /^posture\./;
const KEPT_BY_PRESETS = /^(vowel$|model\.|run\.|constants\.)/;
const SET_BY_THE_PAGE = new Set(["run.duration_s"]);

/**
 * @returns {{parameters: Map, presets: Array, vowels: Array, variants: Array}} parameters by dotted path, with `name`,
 * `short` (abbreviation or symbol) and `decimals` filled in. A posture given directly is off (null) by default.
 */
export function readSchema(document) {
  const parameters = new Map();
  for (const row of document.parameters) {
    if (SET_BY_THE_PAGE.has(row.key)) continue;
    const named = MUSCLE.exec(row.label);
    const given = GIVEN_POSTURE.test(row.key);
    parameters.set(row.key, {
      ...row,
      default: given ? null : row.default,
      nullable: row.nullable || given,
      name: capital(named ? named[1] : row.label),
      short: named ? named[2] : row.symbol,
      decimals: decimalsOf(row.step),
    });
  }
  return { parameters, presets: document.presets, vowels: document.vowels, variants: document.variants };
}

export const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

const decimalsOf = (step) => (step ? Math.max(0, -Math.floor(Math.log10(step) + 1e-9)) : 3);

export function defaultValues(schema) {
  return Object.fromEntries([...schema.parameters].map(([key, row]) => [key, row.default]));
}

/** Only what differs from the defaults, so that links and requests stay short. */
export function changedValues(schema, values) {
  return Object.fromEntries(
    [...schema.parameters.keys()]
      .filter((key) => values[key] !== schema.parameters.get(key).default)
      .map((key) => [key, values[key]]),
  );
}

/** {"activation.ta": 0.5} → {"activation": {"ta": 0.5}} */
export function nest(flat) {
  const document = {};
  for (const [path, value] of Object.entries(flat)) {
    const parts = path.split(".");
    const leaf = parts.pop();
    let place = document;
    for (const part of parts) place = place[part] ??= {};
    place[leaf] = value;
  }
  return document;
}

export function flatten(document, prefix = "") {
  const flat = {};
  for (const [key, value] of Object.entries(document)) {
    const path = prefix + key;
    if (value !== null && typeof value === "object") Object.assign(flat, flatten(value, `${path}.`));
    else flat[path] = value;
  }
  return flat;
}

export function simulationRequest(schema, values, run = {}) {
  const body = nest(changedValues(schema, values));
  body.kind = "simulation";
  body.run = { ...body.run, ...run };
  return body;
}

/** The posture call takes the same document without the run. */
export function postureRequest(schema, values) {
  const { run, ...body } = simulationRequest(schema, values);
  return body;
}

/** The values of a preset; values that it does not name are unchanged. */
export function presetValues(schema, preset, values) {
  return { ...values, ...wantedBy(schema, preset) };
}

/** The preset with these values, or null. */
export function presetOf(schema, values) {
  const is = (preset) => Object.entries(wantedBy(schema, preset)).every(([key, value]) => values[key] === value);
  return schema.presets.find(is) ?? null;
}

const wanted = new WeakMap();

function wantedBy(schema, preset) {
  if (!wanted.has(preset)) {
    const all = { ...defaultValues(schema), ...flatten(preset.request) };
    wanted.set(preset, Object.fromEntries(Object.entries(all).filter(([key]) => !KEPT_BY_PRESETS.test(key))));
  }
  return wanted.get(preset);
}

/** The user's input as a number if it is one, else the text itself, which the server then refuses by name. */
export function typed(text) {
  const trimmed = text.trim().replace(",", ".").replace("−", "-");
  if (trimmed === "") return null;
  const number = Number(trimmed);
  return Number.isFinite(number) ? number : text.trim();
}
