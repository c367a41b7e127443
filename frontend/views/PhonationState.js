/** The state of phonation in words: what it is, why, and what would help. */
import { html } from "../ui.js";
import { capital } from "../params.js";
import { measured } from "../result.js";
import { failure, result } from "../state/outcome.js";
import { preset, values } from "../state/request.js";
import { connection } from "../state/session.js";
import { APP, STATES, hintFor } from "../texts.js";

/** `withLook`: what to look for in the preset chosen, where the page has no other place for it. */
export function PhonationState({ withLook = false }) {
  const shown = result.value;
  const state = shown?.state ?? "waiting";
  const hint = shown?.state === "none" ? hintFor(values.peek(), measured(shown, "gap_mm") ?? 0) : "";
  return html`
    <div class="phonation" data-state=${state}>
      <p class="phonation-state"><i class="state-mark" aria-hidden="true"></i>${shown ? STATES[state] : APP.waiting}</p>
      <p class="phonation-why" title=${hint}>${hint && html`<strong>${hint}</strong> `}<span key=${hint}>${lineOf(shown, withLook && preset.value?.look_for)}</span></p>
    </div>
  `;
}

function lineOf(shown, look) {
  if (connection.value === "offline") return APP.offline;
  if (failure.value) return failure.value;
  if (look && shown) return look;
  // The state's own name stands above already.
  return shown ? capital(shown.explanation.replace(/^(Periodic|Subharmonic|Irregular|No phonation|No sustained phonation): /, "")) : "";
}
