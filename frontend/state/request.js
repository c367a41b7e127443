/** The request: the schema, every value, and the movement of a control that a change belongs to. */
import { batch, computed, readonly, signal } from "../core/ui.js";
import { capital, defaultValues, flatten, presetOf, presetValues } from "../core/parameters.js";

const MOVEMENT_PAUSE_MS = 1500;
const TIED = { "activation.lca": "activation.ia", "activation.ia": "activation.lca" };

const _schema = signal(null);
const _catalogue = signal(null);
/** @type {import("@preact/signals").Signal<Record<string, any>>} */
const _values = signal({});
const _version = signal(0);
const _movement = signal(0);
const _tied = signal(false);

export const schema = readonly(_schema);
export const catalogue = readonly(_catalogue);
/** Every value by dotted path, as it is sent. */
export const values = readonly(_values);
/** Counts changes: an answer carries the version of its request. */
export const version = readonly(_version);
/** Counts movements: changes of one control without a pause are one movement. */
export const movement = readonly(_movement);
export const tied = readonly(_tied);
export const preset = computed(() => (_schema.value ? presetOf(_schema.value, _values.value) : null));

export function begin(newSchema, catalogueRows, changes) {
  batch(() => {
    _schema.value = newSchema;
    _catalogue.value = new Map(catalogueRows.map((row) => [row.key, { ...row, name: capital(row.name) }]));
    _values.value = { ...defaultValues(newSchema), ...changes };
    _version.value = 1;
  });
}

let lastPath = "";
let lastChange = 0;

/** The paths that a control sets: its own, and the one tied to it. */
export const movedTogether = (path) => (_tied.peek() && TIED[path] ? [path, TIED[path]] : [path]);

export function setValue(path, value) {
  const moved = Object.fromEntries(movedTogether(path).map((tied) => [tied, value]));
  change({ ..._values.value, ...moved }, path);
}

export function resetValue(path) {
  setValue(path, _schema.value.parameters.get(path).default);
}

export function choosePreset(key) {
  const chosen = _schema.value.presets.find((row) => row.key === key);
  change(presetValues(_schema.value, chosen, _values.value), `preset ${key}`);
}

/** Set many values at once, for undo or a lesson; missing ones are unchanged. */
export function restoreValues(next) {
  change({ ..._values.value, ...next }, "restored");
  lastPath = ""; // two in a row are two movements
}

/** A variant brings its own source–tract coupling, which can be changed afterwards. */
export function chooseVariant(key) {
  const { coupling } = _schema.value.variants.find((row) => row.key === key);
  change({ ..._values.value, "model.variant": key, "model.coupling": coupling }, "model.variant");
}

/** Take a request document, with defaults for all values that it does not name. */
export function takeRequest(document) {
  const known = Object.entries(flatten(document)).filter(([path]) => _schema.value.parameters.has(path));
  change({ ...defaultValues(_schema.value), ...Object.fromEntries(known) }, "request");
}

export function setTied(on) {
  _tied.value = on;
}

function change(next, path) {
  const now = performance.now();
  batch(() => {
    if (path !== lastPath || now - lastChange > MOVEMENT_PAUSE_MS) _movement.value += 1;
    _values.value = next;
    _version.value += 1;
  });
  lastPath = path;
  lastChange = now;
}

export const musclePaths = () =>
  [...schema.value.parameters.values()].filter((row) => row.group === "muscles").map((row) => row.key);

/** "activation.ta" → "ta", which is also the name of the muscle's colour. */
export const muscleOf = (path) => path.split(".").at(-1);
