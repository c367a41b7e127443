/** What a measure means: definition, formula, settings, expected values, source. */
import { html } from "../ui.js";
import { numberText } from "../plots/axis.js";
import { WithSymbols } from "../symbol.js";
import { result } from "../state/outcome.js";
import { catalogue } from "../state/request.js";
import { MEASURE } from "../texts.js";
import { Dialog } from "./Dialog.js";
import { valueText } from "./measure-text.js";

export function MeasureDialog({ about: { key } }) {
  const row = catalogue.value.get(key);
  const shown = result.value;
  const measure = shown?.measures[key];
  const rows = [
    [MEASURE.definition, row.definition],
    [MEASURE.formula, row.formula],
    [MEASURE.threshold, row.threshold],
    [MEASURE.signal, row.signal],
    [MEASURE.normal, rangeText(row)],
    [MEASURE.source, row.source],
  ];
  return html`
    <${Dialog} title=${`${row.name}, ${row.symbol}`}>
      <p class="dialog-value">${valueText(measure, row)}</p>
      ${measure?.reason && html`<p class="reason">${measure.reason}</p>`}
      <dl class="facts">${rows.filter(([, text]) => text).map(([name, text]) => html`<dt>${name}</dt><dd><${WithSymbols} text=${text} /></dd>`)}</dl>
      <p class="caution">${MEASURE.cycles(shown?.cycles)} ${MEASURE.caution}</p>
    <//>
  `;
}

function rangeText(row) {
  if (!row.normal_range) return MEASURE.noRange;
  const { low, high, who, source } = row.normal_range;
  const decimals = Number.isInteger(low) && Number.isInteger(high) ? 0 : row.decimals;
  const unit = row.unit === "1" ? "" : ` ${row.unit}`;
  const value = low === high ? MEASURE.about(numberText(low, decimals)) : MEASURE.fromTo(numberText(low, decimals), numberText(high, decimals));
  return `${value}${unit}: ${who} (${source})`;
}
