/** The address holds the patch, so a copied link is a saved voice. */
import { rowAt } from "../../core/parameters.js";
import { effect } from "../../core/ui.js";
import { mapShown, section } from "../../state/look.js";
import { patch, schema } from "../../state/request.js";

const SECTION = "paper";
const MAP = "map";
const PAUSE_MS = 300; // browsers refuse more than a few address changes a second

/** {patch, unknown}: the patch in a query string, and names without a parameter. */
export function readQuery(knownSchema, query) {
  const read = {};
  const unknown = [];
  for (const [path, text] of new URLSearchParams(query)) {
    const row = rowAt(knownSchema, path);
    if (path === SECTION || path === MAP) continue;
    if (!row) unknown.push(path);
    else if (text !== "" || !row.nullable) read[path] = valueOf(row, text);
  }
  return { patch: read, unknown };
}

/** The text itself where it cannot be a value of the parameter: the server then refuses it by name. */
function valueOf(row, text) {
  if (text === "") return null;
  if (row.type === "boolean") return { true: true, false: false }[text] ?? text;
  return row.options || !Number.isFinite(Number(text)) ? text : Number(text);
}

/** `openSection`: the open part of the Paper section, or null; `withMap`: the map is open. */
export function writeQuery(knownSchema, ofPatch, openSection = null, withMap = false) {
  const query = new URLSearchParams();
  const { parameters } = knownSchema;
  const paths = [...parameters.keys()].filter((path) => path in ofPatch); // in the order of the schema
  const beyond = Object.keys(ofPatch).filter((path) => !parameters.has(path) && rowAt(knownSchema, path));
  for (const path of [...paths, ...beyond.sort()]) query.set(path, ofPatch[path] ?? "");
  if (openSection) query.set(SECTION, openSection);
  else if (withMap) query.set(MAP, "");
  return query.toString();
}

/** The address of the present page, without the delay of the address bar. */
export function linkOf(knownSchema, ofPatch, openSection = null, withMap = false) {
  const here = new URL(location.href);
  here.search = writeQuery(knownSchema, ofPatch, openSection, withMap);
  here.hash = "";
  return here.href;
}

/** Starts updating the address; returns a function that stops it. */
export function followUrl() {
  let waiting = 0;
  const stop = effect(() => {
    if (!schema.value) return;
    const query = writeQuery(schema.value, patch.value, section.value, mapShown.value);
    clearTimeout(waiting);
    waiting = setTimeout(() => history.replaceState(null, "", query ? `?${query}` : location.pathname), PAUSE_MS);
  });
  return () => {
    stop();
    clearTimeout(waiting);
  };
}
