/** All measures as a table that can be copied, and the dialog that explains one of them. */
import { html, useState } from "../../core/ui.js";
import { numberText } from "../../core/axis.js";
import { copyText } from "../../core/clipboard.js";
import { Dialog, openDialog } from "../../core/dialog.js";
import { MathsSymbol, WithSymbols } from "../../core/maths-symbol.js";
import { capital } from "../../core/parameters.js";
import { result } from "../../state/answers.js";
import { catalogue, schema } from "../../state/request.js";
import { COPY_TABLE, MEASURE } from "./texts.js";
import { cautionOf, rangeOf, valueText } from "./value-text.js";

export function MeasureTable() {
  if (!catalogue.value) return null;
  const groups = Map.groupBy([...catalogue.value.values()], (row) => row.group);
  return html`
    <div class="measure-table" tabindex="0" role="region" aria-label=${MEASURE.table}>
      <${CopyButton} />
      <table>
        <caption class="visually-hidden">${MEASURE.table}</caption>
        <thead>
          <tr>
            ${MEASURE.columns.map(
              (name) => html`
                <th key=${name} scope="col">${name}</th>
              `,
            )}
          </tr>
        </thead>
        ${[...groups].map(
          ([group, rows]) => html`
            <tbody key=${group}>
              <tr class="measure-group"><th colspan="3" scope="colgroup">${capital(group)}</th></tr>
              ${rows.map(
                (row) => html`
                  <${Row} key=${row.key} row=${row} />
                `,
              )}
            </tbody>
          `,
        )}
      </table>
      <p class="caution">${cautionOf(result.value, schema.value)}</p>
    </div>
  `;
}

function CopyButton() {
  const [outcome, setOutcome] = useState("");
  const copy = async () => {
    const rows = measureRows(catalogue.peek(), result.peek()?.measures ?? {}, COPY_TABLE.columns);
    setOutcome((await copyText(asTsv(rows), asMarkup(rows))) ? COPY_TABLE.copied : COPY_TABLE.failed);
  };
  return html`
    <p class="copy-table">
      <span role="status" class="when">${outcome}</span>
      <button type="button" class="button small" onClick=${copy}>${COPY_TABLE.copy}</button>
    </p>
  `;
}

function Row({ row }) {
  const measure = result.value?.measures[row.key];
  return html`
    <tr data-measure=${row.key}>
      <th scope="row">
        <button type="button" class="plain" onClick=${() => openDialog("measure", { key: row.key })}>
          ${row.name}
        </button>
        ${" "}
        <${MathsSymbol} text=${row.symbol} />
      </th>
      <td class="value">${valueText(measure, row)}</td>
      <td class="expected">
        ${
          row.normal_range &&
          html`
            ${rangeOf(row)}${" "}
            <span class="source">${row.normal_range.source}</span>
          `
        }
      </td>
    </tr>
    ${
      measure?.reason &&
      html`
        <tr class="why"><td colspan="3" class="reason">${measure.reason}</td></tr>
      `
    }
  `;
}

/** Rows for a spreadsheet: name, symbol, value, unit, published range, source, definition, reason. Pure. */
export function measureRows(catalogue, measures, words) {
  const rows = [...catalogue.values()].map((row) => {
    const measure = measures[row.key];
    const range = row.normal_range ? `${row.normal_range.low} – ${row.normal_range.high}` : "";
    return [
      row.name,
      row.symbol,
      measure?.value ?? "",
      row.unit,
      range,
      row.normal_range?.source ?? "",
      row.definition,
      measure?.reason ?? "",
    ];
  });
  return [words, ...rows];
}

export const asTsv = (rows) =>
  rows.map((row) => row.map((cell) => String(cell).replace(/[\t\n]/g, " ")).join("\t")).join("\n");

/** The same rows as an HTML table, for text documents. Pure. */
export function asMarkup(rows) {
  const cell = (text) => `<td>${String(text).replace(/[&<>]/g, (sign) => `&#${sign.charCodeAt(0)};`)}</td>`;
  return `<table>${rows.map((row) => `<tr>${row.map(cell).join("")}</tr>`).join("")}</table>`;
}

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
      ${
        measure?.reason &&
        html`
          <p class="reason">${measure.reason}</p>
        `
      }
      <dl class="facts">
        ${rows
          .filter(([, text]) => text)
          .map(
            ([name, text]) => html`
              <dt>${name}</dt>
              <dd><${WithSymbols} text=${text} /></dd>
            `,
          )}
      </dl>
      <p class="caution">${MEASURE.cycles(shown?.cycles)}${" "}${cautionOf(shown, schema.value)}</p>
    <//>
  `;
}

function rangeText(row) {
  if (!row.normal_range) return MEASURE.noRange;
  const { low, high, who, source } = row.normal_range;
  const decimals = Number.isInteger(low) && Number.isInteger(high) ? 0 : row.decimals;
  const unit = row.unit === "1" ? "" : ` ${row.unit}`;
  const value =
    low === high
      ? MEASURE.about(numberText(low, decimals))
      : MEASURE.fromTo(numberText(low, decimals), numberText(high, decimals));
  return `${value}${unit}: ${who} (${source})`;
}
