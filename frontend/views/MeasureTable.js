/** Every measure with its unit, or the reason why there is none. */
import { html, useState } from "../ui.js";
import { copyText } from "../copy.js";
import { asMarkup, asTsv, measureRows } from "../kept.js";
import { capital } from "../params.js";
import { openDialog } from "../state/look.js";
import { result } from "../state/outcome.js";
import { catalogue } from "../state/request.js";
import { COPY_TABLE, MEASURE } from "../texts.js";
import { Symbol } from "../symbol.js";
import { rangeOf, valueText } from "./measure-text.js";

export function MeasureTable() {
  if (!catalogue.value) return null;
  const groups = Map.groupBy([...catalogue.value.values()], (row) => row.group);
  return html`
    <div class="measure-table" tabindex="0" role="region" aria-label=${MEASURE.table}>
      <${CopyButton} />
      <table>
        <caption class="visually-hidden">${MEASURE.table}</caption>
        <thead><tr>${MEASURE.columns.map((name) => html`<th key=${name} scope="col">${name}</th>`)}</tr></thead>
        ${[...groups].map(([group, rows]) => html`
          <tbody key=${group}>
            <tr class="measure-group"><th colspan="3" scope="colgroup">${capital(group)}</th></tr>
            ${rows.map((row) => html`<${Row} key=${row.key} row=${row} />`)}
          </tbody>
        `)}
      </table>
      <p class="caution">${MEASURE.caution}</p>
    </div>
  `;
}

function CopyButton() {
  const [said, say] = useState("");
  const copy = async () => {
    const rows = measureRows(catalogue.peek(), result.peek()?.measures ?? {}, COPY_TABLE.columns);
    say((await copyText(asTsv(rows), asMarkup(rows))) ? COPY_TABLE.copied : COPY_TABLE.failed);
  };
  return html`<p class="copy-table"><span role="status" class="when">${said}</span><button type="button" class="button small" onClick=${copy}>${COPY_TABLE.copy}</button></p>`;
}

function Row({ row }) {
  const measure = result.value?.measures[row.key];
  return html`
    <tr data-measure=${row.key}>
      <th scope="row"><button type="button" class="plain" onClick=${() => openDialog("measure", { key: row.key })}>${row.name}</button> <${Symbol} text=${row.symbol} /></th>
      <td class="value">${valueText(measure, row)}</td>
      <td class="expected">${row.normal_range && html`${rangeOf(row)} <span class="source">${row.normal_range.source}</span>`}</td>
    </tr>
    ${measure?.reason && html`<tr class="why"><td colspan="3" class="reason">${measure.reason}</td></tr>`}
  `;
}
