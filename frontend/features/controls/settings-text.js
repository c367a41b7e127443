/** Settings as text. */
import { numberText } from "../../core/axis.js";
import { isOfModel } from "../../core/parameters.js";
import { valuesOf } from "../../state/request.js";
import { OPTION_NAMES, VARIANT_NAMES } from "./texts.js";

/** Rows of the schema whose values differ under two patches. Constants that a model brings are named by the model. */
export function differingSettings(schema, a, b) {
  const [before, after] = [valuesOf(a), valuesOf(b)];
  const named = (key) => key in a || key in b || isOfModel(key);
  return [...schema.parameters.values()].filter(({ key }) => before[key] !== after[key] && named(key));
}

/** Short name of a setting: the muscle's abbreviation, else its name. */
export const shortName = (row) => (row.group === "muscles" ? row.short : row.name);

/** A setting's value as people read it, with its unit. */
export function valueOf(row, values) {
  const value = values[row.key];
  if (value === null || value === undefined) return "–";
  if (typeof value !== "number") return OPTION_NAMES[value] ?? VARIANT_NAMES[value] ?? value;
  const decimals = Number(value.toFixed(row.decimals)) === value ? row.decimals : 4;
  return `${numberText(value, decimals)}${!row.unit || row.unit === "1" ? "" : ` ${row.unit}`}`;
}

/** The change of one step of the history: "CT 0.60", "3 settings", a preset's name. `rows`: those that changed. */
export function changeSummary(rows, after, presetLabel, words) {
  if (presetLabel) return presetLabel;
  if (!rows.length) return words.first;
  return rows.length === 1 ? `${shortName(rows[0])} ${valueOf(rows[0], after)}` : words.several(rows.length);
}
