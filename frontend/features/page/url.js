/** The address holds every changed value, so a copied link is a saved voice. */
import { effect } from "../../core/ui.js";
import { changedValues } from "../../core/parameters.js";
import { mapShown, section } from "../../state/look.js";
import { schema, values } from "../../state/request.js";

const SECTION = "paper";
const MAP = "map";
const PAUSE_MS = 300; // browsers refuse more than a few address changes a second

/** {changes, unknown}: values by path from a query string, and names without a parameter. */
export function readQuery(knownSchema, query) {
  const changes = {};
  const unknown = [];
  for (const [path, text] of new URLSearchParams(query)) {
    const row = knownSchema.parameters.get(path);
    if (path === SECTION || path === MAP) continue;
    if (!row) unknown.push(path);
    else
      changes[path] = row.options || text === "" ? text || null : Number.isFinite(Number(text)) ? Number(text) : text;
  }
  return { changes, unknown };
}

/** `openSection`: the open part of the Paper section, or null; `withMap`: the map is open. */
export function writeQuery(knownSchema, allValues, openSection = null, withMap = false) {
  const query = new URLSearchParams();
  for (const [path, value] of Object.entries(changedValues(knownSchema, allValues))) query.set(path, value ?? "");
  if (openSection) query.set(SECTION, openSection);
  else if (withMap) query.set(MAP, "");
  return query.toString();
}

/** The address of the present page, without the delay of the address bar. */
export function linkOf(knownSchema, allValues, openSection = null, withMap = false) {
  const here = new URL(location.href);
  here.search = writeQuery(knownSchema, allValues, openSection, withMap);
  here.hash = "";
  return here.href;
}

/** Starts updating the address; returns a function that stops it. */
export function followUrl() {
  let waiting = 0;
  const stop = effect(() => {
    if (!schema.value) return;
    const query = writeQuery(schema.value, values.value, section.value, mapShown.value);
    clearTimeout(waiting);
    waiting = setTimeout(() => history.replaceState(null, "", query ? `?${query}` : location.pathname), PAUSE_MS);
  });
  return () => {
    stop();
    clearTimeout(waiting);
  };
}
