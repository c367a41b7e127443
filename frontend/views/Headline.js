/** One large number; a tap opens what it means. */
import { html } from "../ui.js";
import { numberText } from "../plots/axis.js";
import { openDialog } from "../state/look.js";
import { catalogue } from "../state/request.js";
import { MEASURE } from "../texts.js";
import { Symbol } from "../symbol.js";
import { expected } from "./measure-text.js";

export function Headline({ item, shown }) {
  const row = catalogue.value?.get(item.key);
  const measure = shown?.measures[item.key];
  const has = measure && measure.value !== null;
  const value = has ? numberText(measure.value * (item.factor ?? 1), item.decimals ?? row.decimals) : "–";
  const unit = item.unit ?? (row?.unit === "1" ? "" : row?.unit);
  return html`
    <button type="button" class="headline" data-measure=${item.key} disabled=${!row} title=${row && MEASURE.open(row.name)} onClick=${() => openDialog("measure", { key: item.key })}>
      <span class="headline-label">${item.label} ${row && html`<${Symbol} text=${row.symbol} />`}</span>
      <span class="headline-value"><b>${value}</b> <span class="unit">${unit}</span></span>
      <span class="headline-note">${noteOf(item, row, shown)}</span>
    </button>
  `;
}

function noteOf(item, row, shown) {
  const other = item.also && shown?.measures[item.also.key];
  if (other && other.value !== null) return `${item.also.label} ${numberText(other.value, 1)} ${other.unit}`;
  return row?.normal_range ? expected(row, item) : "";
}
