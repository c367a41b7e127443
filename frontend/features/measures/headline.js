/** The state of phonation in words, and the large numbers. */
import { html } from "../../core/ui.js";
import { numberText } from "../../core/axis.js";
import { openDialog } from "../../core/dialog.js";
import { MathsSymbol } from "../../core/maths-symbol.js";
import { capital } from "../../core/parameters.js";
import { measured } from "../../core/result.js";
import { APP, STATES } from "../../core/texts.js";
import { failure, result } from "../../state/answers.js";
import { catalogue, preset, values } from "../../state/request.js";
import { connection } from "../../state/session.js";
import { hintFor, MEASURE } from "./texts.js";
import { expected } from "./value-text.js";

/** `withLook`: also show what to look for in the chosen preset, where the page has no other place for it. */
export function PhonationState({ withLook = false }) {
  const shown = result.value;
  const state = shown?.state ?? "waiting";
  const hint = shown?.state === "none" ? hintFor(values.peek(), measured(shown, "gap_mm") ?? 0) : "";
  return html`
    <div class="phonation" data-state=${state}>
      <p class="phonation-state">
        <i class="state-mark" aria-hidden="true"></i>
        ${shown ? STATES[state] : APP.waiting}
      </p>
      <p class="phonation-why" title=${hint}>
        ${
          hint &&
          html`
            <strong>${hint}</strong>
            ${" "}
          `
        }
        <span key=${hint}>${lineOf(shown, withLook && preset.value?.look_for)}</span>
      </p>
    </div>
  `;
}

function lineOf(shown, look) {
  if (connection.value === "offline") return APP.offline;
  if (failure.value) return failure.value;
  if (look && shown) return look;
  // The name of the state is already above.
  return shown
    ? capital(shown.explanation.replace(/^(Periodic|Subharmonic|Irregular|No phonation|No sustained phonation): /, ""))
    : "";
}

export function Headline({ item, shown }) {
  const row = catalogue.value?.get(item.key);
  const measure = shown?.measures[item.key];
  const has = measure && measure.value !== null;
  const value = has ? numberText(measure.value * (item.factor ?? 1), item.decimals ?? row.decimals) : "–";
  const unit = item.unit ?? (row?.unit === "1" ? "" : row?.unit);
  return html`
    <button
      type="button"
      class="headline"
      data-measure=${item.key}
      disabled=${!row}
      title=${row && MEASURE.open(row.name)}
      onClick=${() => openDialog("measure", { key: item.key })}
    >
      <span class="headline-label">
        ${item.label}${" "}${
          row &&
          html`
            <${MathsSymbol} text=${row.symbol} />
          `
        }
      </span>
      <span class="headline-value">
        <b>${value}</b>
        ${" "}
        <span class="unit">${unit}</span>
      </span>
      <span class="headline-note">${noteOf(item, row, shown)}</span>
    </button>
  `;
}

function noteOf(item, row, shown) {
  const other = item.also && shown?.measures[item.also.key];
  if (other && other.value !== null) return `${item.also.label} ${numberText(other.value, 1)} ${other.unit}`;
  return row?.normal_range ? expected(row, item) : "";
}
