/** The medial surface with its pressures at the phase under the cursor. */
import { html, useComputed } from "../ui.js";
import { niceCeil } from "../plots/axis.js";
import { readout } from "../state/motion.js";
import { result } from "../state/outcome.js";
import { MAPS } from "../texts.js";
import { FieldMap } from "./FieldMap.js";

const LEAST_PA = 100; // a map of rounding errors helps nobody

export function Maps() {
  const at = useComputed(() => (result.value?.cycle.complete === false ? MAPS.atEnd : MAPS.at(Math.floor(readout.value * 100))));
  return html`
    <section class="maps card" aria-label=${MAPS.where}>
      <div class="card-head"><h2>${MAPS.where}</h2><span class="when">${at}</span></div>
      <${FieldMap} name="aero" title=${MAPS.aero} scaleOf=${pressureScale} moment=${() => at.peek()} />
      <${FieldMap} name="contact" title=${MAPS.contact} scaleOf=${contactScale} moment=${() => at.peek()} />
    </section>
  `;
}

/** Limits over the whole cycle, round and centred on zero. */
export function pressureScale({ aeroRange: { min, max } }) {
  const limit = niceCeil(Math.max(-min, max, LEAST_PA));
  return { kind: "diverging", limit, low: -limit };
}

/** From zero up; below it only as far as contact holds instead of pushing. */
export function contactScale({ contactRange: { min, max } }) {
  return { kind: "sequential", limit: niceCeil(Math.max(max, LEAST_PA)), low: min < 0 ? -niceCeil(-min) : 0 };
}
