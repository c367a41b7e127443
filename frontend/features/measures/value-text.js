/** Values and published ranges of measures as text. Pure. */
import { numberText } from "../../core/axis.js";
import { MEASURE } from "./texts.js";

/** The published range, "1.3 – 2.8", in the unit of the page. */
export function rangeOf(row, { factor = 1, decimals = row.decimals } = {}) {
  const { low, high } = row.normal_range;
  const text = (v) => numberText(v * factor, decimals);
  const short = (v) =>
    text(v)
      .replace(/(\.\d*?)0+$/, "$1")
      .replace(/\.$/, "");
  return low === high ? short(low) : `${short(low)} – ${short(high)}`;
}

/** "usual 1.3 – 2.8" */
export const expected = (row, shown) => MEASURE.usual(rangeOf(row, shown));

/** What to mind when reading the measures of a result, if its variant has the paper's constants; else "". */
export function cautionOf(result, { variants }) {
  const variant = variants.find(({ key }) => key === result?.provenance.request.model.variant);
  return variant?.changes.length === 0 ? MEASURE.caution : "";
}

/** Value with unit, or a dash. */
export function valueText(measure, row) {
  if (!measure || measure.value === null) return "–";
  return `${numberText(measure.value, row.decimals)}${row.unit === "1" ? "" : ` ${row.unit}`}`;
}
