/**
 * The request: a patch {path: value} of what was set, and the values in force, which the server resolves. The page has
 * no rule of its own about defaults.
 */
import { batch, computed, readonly, signal } from "../core/ui.js";
import {
  basisOf,
  capital,
  entriesOf,
  isOfModel,
  keptByPresets,
  optionalPartOf,
  patchText,
  presetOf,
} from "../core/parameters.js";

const MOVEMENT_PAUSE_MS = 1500;
const TIED = { "activation.lca": "activation.ia", "activation.ia": "activation.lca" };

const _schema = signal(null);
const _catalogue = signal(null);
/** @type {import("@preact/signals").Signal<Record<string, any>>} */
const _patch = signal({});
/** @type {import("@preact/signals").Signal<Map<string, Record<string, any>>>} */
const _resolved = signal(new Map());
/** @type {import("@preact/signals").Signal<Record<string, any>>} */
const _shown = signal({});
const _refused = signal("");
const _version = signal(0);
const _movement = signal(0);
const _tied = signal(false);

export const schema = readonly(_schema);
export const catalogue = readonly(_catalogue);
/** What was set by the user, a preset, a link, a lesson or a map, by dotted path. It is sent as it is. */
export const patch = readonly(_patch);
/** Counts changes: an answer carries the version of its request. */
export const version = readonly(_version);
/** Counts movements: changes of one control without a pause are one movement. */
export const movement = readonly(_movement);
export const tied = readonly(_tied);

const textOfBasis = (of) => patchText(basisOf(_schema.value, of));
/** The basis of the present patch as text, see basisOf. */
export const basis = computed(() => textOfBasis(_patch.value));

/** Values in force under the basis of a patch. Until the server has answered: those shown before. */
export const defaultsOf = (of) => _resolved.value.get(textOfBasis(of)) ?? _shown.value;
/** Values in force under a patch, by path; null for what is not given. */
export const valuesOf = (of) => ({ ...defaultsOf(of), ...of });
export const defaults = computed(() => defaultsOf(_patch.value));
export const values = computed(() => valuesOf(_patch.value));
/** Whether the defaults of the present basis have not arrived yet. */
export const awaitsDefaults = computed(() => !_resolved.value.has(basis.value) && _refused.value !== basis.value);
export const preset = computed(() => _schema.value && presetOf(_schema.value, _patch.value, defaults.value));

/** `first`: {basis, values}, the first defaults, see takeDefaults. */
export function begin(newSchema, catalogueRows, newPatch, first) {
  batch(() => {
    _schema.value = newSchema;
    _resolved.value = new Map(); // those of an earlier schema say nothing of this one
    _refused.value = "";
    _shown.value = takeDefaults(first.basis, first.values);
    _catalogue.value = new Map(catalogueRows.map((row) => [row.key, { ...row, name: capital(row.name) }]));
    _patch.value = newPatch;
    _version.value = 1;
  });
}

/** The values in force under a basis, as the server resolved them. */
export function takeDefaults(ofBasis, resolved) {
  const text = patchText(ofBasis);
  const paths = [..._schema.peek().parameters.keys()];
  const own = Object.fromEntries(paths.map((path) => [path, resolved[path] ?? null]));
  batch(() => {
    _resolved.value = new Map(_resolved.peek()).set(text, own);
    show();
  });
  return own;
}

/** The server refused this basis: the defaults shown before stay. */
export function takeNoDefaults(ofBasis) {
  _refused.value = patchText(ofBasis);
}

function show() {
  _shown.value = _resolved.peek().get(basis.peek()) ?? _shown.peek();
}

let lastPath = "";
let lastChange = 0;

/** The paths that a control sets: its own, and the one tied to it. */
export const movedTogether = (path) => (_tied.peek() && TIED[path] ? [path, TIED[path]] : [path]);

/** Null: no value of its own. */
export function setValue(path, value) {
  change(withEntries(_patch.peek(), Object.fromEntries(movedTogether(path).map((tied) => [tied, value]))), path);
}

export function resetValue(path) {
  setValue(path, null);
}

export function choosePreset(key) {
  const chosen = _schema.peek().presets.find((row) => row.key === key);
  change(withEntries(keptByPresets(_schema.peek(), _patch.peek()), entriesOf(chosen)), `preset ${key}`);
}

/** Exactly this patch again, for undo; or, for a lesson or a cell of a map, this patch with further entries. */
export function restorePatch(base, entries = {}) {
  change(withEntries(base, entries), "restored");
  lastPath = ""; // two in a row are two movements
}

/** A variant brings its own source–tract coupling, which can be changed afterwards. */
export function chooseVariant(key) {
  const usual = _schema.peek().parameters.get("model.variant").default;
  const entries = { "model.variant": key === usual ? null : key, "model.coupling": null };
  change(withEntries(_patch.peek(), entries), "model.variant");
}

export function setTied(on) {
  _tied.value = on;
}

/**
 * A patch with further entries, without those that are in force anyway, so that links stay short. An entry of the
 * basis stays, because it changes which values are in force.
 */
function withEntries(base, entries) {
  const next = { ...base, ...entries };
  const own = _resolved.peek().get(textOfBasis(next));
  const isOfBasis = (path) => isOfModel(path) || optionalPartOf(_schema.peek(), path) !== null;
  const isNeedless = ([path, value]) => value === null || (own && !isOfBasis(path) && own[path] === value);
  for (const [path] of Object.entries(entries).filter(isNeedless)) delete next[path];
  return next;
}

function change(next, path) {
  const now = performance.now();
  batch(() => {
    if (path !== lastPath || now - lastChange > MOVEMENT_PAUSE_MS) _movement.value += 1;
    _patch.value = next;
    _version.value += 1;
    show();
  });
  lastPath = path;
  lastChange = now;
}

export const musclePaths = () =>
  [...schema.value.parameters.values()].filter((row) => row.group === "muscles").map((row) => row.key);

/** "activation.ta" → "ta", which is also the name of the muscle's colour. */
export const muscleOf = (path) => path.split(".").at(-1);
