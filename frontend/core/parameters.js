/** The server's parameter schema as the page uses it; patches and what is made of them. */

const MUSCLE = /^(.*) \(([A-Z]+)\)$/;
const OF_MODEL = /^model\./;
const SET_BY_THE_PAGE = new Set(["run.duration_s"]);

/**
 * @returns {{parameters: Map, presets: Array, vowels: Array, variants: Array, sides: string[], lists: Array}}
 * parameters by dotted path, with `name`,
 * `short` (abbreviation or symbol), `decimals` and `options` (also of a boolean) filled in. Values of an optional part
 * may be null: not given.
 */
export function readSchema(document) {
  const parameters = new Map();
  for (const row of document.parameters) {
    if (SET_BY_THE_PAGE.has(row.key)) continue;
    const named = MUSCLE.exec(row.label);
    parameters.set(row.key, {
      ...row,
      nullable: row.nullable || Boolean(row.optional_part),
      options: row.type === "boolean" ? [true, false] : row.options,
      name: capital(named ? named[1] : row.label),
      short: named ? named[2] : row.symbol,
      decimals: decimalsOf(row.step),
    });
  }
  const { presets, vowels, variants, sides, lists } = document;
  return { parameters, presets, vowels, variants, sides, lists };
}

/**
 * The row of any path of a patch: its own, that of the same value on one side (right.activation.ta), or that of a value
 * of an object in a list (lesions.0.height_mm). Null for what no request has.
 */
export function rowAt(schema, path) {
  const [first, ...rest] = path.split(".");
  if (schema.sides.includes(first)) {
    const row = schema.parameters.get(rest.join("."));
    return row?.per_side ? row : null;
  }
  const list = schema.lists.find((one) => one.key === first);
  if (!list) return schema.parameters.get(path) ?? null;
  const [position, name, ...more] = rest;
  const isPlace = /^(0|[1-9]\d*)$/.test(position) && Number(position) < list.at_most && !more.length;
  return (isPlace && list.parameters.find((row) => row.key === name)) || null;
}

export const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

const decimalsOf = (step) => (step ? Math.max(0, -Math.floor(Math.log10(step) + 1e-9)) : 3);

/** Whether a path chooses the equations, on which the defaults of all other values depend. */
export const isOfModel = (path) => OF_MODEL.test(path);

/** The optional part that a path belongs to, or null. */
export const optionalPartOf = (schema, path) => schema.parameters.get(path)?.optional_part ?? null;

/** Names of the optional parts of which a patch gives a value. */
export const partsGiven = (schema, patch) =>
  new Set(
    Object.entries(patch)
      .filter(([, value]) => value !== null)
      .map(([path]) => optionalPartOf(schema, path))
      .filter((part) => part !== null),
  );

/**
 * What the values in force of a patch depend on, beyond its own entries: the entries that choose the equations, and
 * {} for each optional part that it gives. It is itself a patch.
 */
export const basisOf = (schema, patch) => ({
  ...Object.fromEntries(Object.entries(patch).filter(([path]) => isOfModel(path))),
  ...Object.fromEntries([...partsGiven(schema, patch)].map((part) => [part, {}])),
});

/**
 * A patch as text, equal for equal patches, without the entries at the paths `except`.
 *
 * @param {Record<string, any>} patch
 * @param {string[]} [except]
 */
export const patchText = (patch, except = []) =>
  JSON.stringify(
    Object.keys(patch)
      .filter((path) => !except.includes(path))
      .sort()
      .map((path) => [path, patch[path]]),
  );

/** The entries of a patch whose paths are parameters of the page, sides and lists included. */
export const known = (schema, patch) =>
  Object.fromEntries(Object.entries(patch).filter(([path]) => rowAt(schema, path)));

/** {"activation.ta": 0.5} → {"activation": {"ta": 0.5}}; objects of a list are by position, {"lesions": {"0": {…}}} */
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

/** The body of a run: the patch as it is, with values of the run that the page sets itself. */
export function simulationRequest(patch, run = {}) {
  const body = nest(patch);
  body.kind = "simulation";
  body.run = { ...body.run, ...run };
  return body;
}

/** The posture call takes the same document without the run. */
export function postureRequest(patch) {
  const { run, ...body } = simulationRequest(patch);
  return body;
}

/**
 * The entries of a patch that a preset leaves alone: those outside the groups that presets set and outside the groups
 * of optional parts. A preset also takes back every optional part, which could replace the muscles.
 */
export function keptByPresets(schema, patch) {
  const groupOf = (path) => rowAt(schema, path)?.group;
  const ofPresets = schema.presets.flatMap((preset) => Object.keys(entriesOf(preset)).map(groupOf));
  const ofParts = [...schema.parameters.values()].filter((row) => row.optional_part).map((row) => row.group);
  const set = new Set([...ofPresets, ...ofParts]);
  const isKept = (path) => optionalPartOf(schema, path) === null && !set.has(groupOf(path));
  return Object.fromEntries(Object.entries(patch).filter(([path]) => isKept(path)));
}

/** The preset whose values are in force under a patch, or null. `defaults`: the values in force under its basis. */
export function presetOf(schema, patch, defaults) {
  const basis = patchText(basisOf(schema, patch));
  const kept = keptByPresets(schema, patch);
  const is = (preset) => {
    const wanted = { ...kept, ...entriesOf(preset) };
    const paths = Object.keys({ ...patch, ...wanted });
    const valueUnder = (of, path) => (path in of ? of[path] : defaults[path]);
    return (
      patchText(basisOf(schema, wanted)) === basis &&
      paths.every((path) => valueUnder(patch, path) === valueUnder(wanted, path))
    );
  };
  return schema.presets.find(is) ?? null;
}

const flattened = new WeakMap();

/** What a preset sets, by path. */
export function entriesOf(preset) {
  if (!flattened.has(preset)) flattened.set(preset, flatten(preset.request));
  return flattened.get(preset);
}

/** The user's input as a number if it is one, else the text itself, which the server then refuses by name. */
export function typed(text) {
  const trimmed = text.trim().replace(",", ".").replace("−", "-");
  if (trimmed === "") return null;
  const number = Number(trimmed);
  return Number.isFinite(number) ? number : text.trim();
}
