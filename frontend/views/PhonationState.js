/** The state of phonation in words: what it is, why, and what would help. */
import { html } from "../ui.js";
import { capital } from "../params.js";
import { measured } from "../result.js";
import { failure, result } from "../state/outcome.js";
import { values } from "../state/request.js";
import { connection } from "../state/session.js";
import { APP, STATES, hintFor } from "../texts.js";

export function PhonationState() {
  const shown = result.value;
  const state = shown?.state ?? "waiting";
  const hint = shown?.state === "none" ? hintFor(values.peek(), measured(shown, "gap_mm") ?? 0) : "";
  return html`
    <div class="phonation" data-state=${state}>
      <p class="phonation-state"><i class="state-mark" aria-hidden="true"></i>${shown ? STATES[state] : APP.waiting}</p>
      <p class="phonation-why" title=${hint}>${hint && html`<strong>${hint}</strong> `}${lineOf(shown)}</p>
    </div>
  `;
}

function lineOf(shown) {
  if (connection.value === "offline") return APP.offline;
  if (failure.value) return failure.value;
  // The state's own name stands above already.
  return shown ? capital(shown.explanation.replace(/^(Periodic|Subharmonic|Irregular|No phonation|No sustained phonation): /, "")) : "";
}
