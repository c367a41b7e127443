/** Six moments of the cycle; the one under the shared cursor is framed, and a press on one holds it. */
import { computed, html, useComputed } from "../ui.js";
import { MOMENTS, columnOf, drawColumns, phaseAt } from "../plots/cycle-strip-draw.js";
import { palette, rootPx, smallFont } from "../plots/theme.js";
import { isVoiced } from "../result.js";
import { holdPhase, readout } from "../state/motion.js";
import { rested } from "../state/rested.js";
import { FOLDS } from "../texts.js";
import { contactScale, pressureScale } from "./Maps.js";
import { Picture } from "./Picture.js";

const strip = computed(() => {
  if (!isVoiced(rested.value)) return null;
  const { fields } = rested.value;
  const columns = Array.from({ length: MOMENTS }, (_, k) => columnOf(fields, phaseAt(k), FOLDS.strip.moment(Math.round(100 * phaseAt(k)))));
  const reach = Math.max(1, ...columns.flatMap(({ edges }) => [...edges.superior, ...edges.inferior]));
  return { columns, reach, scales: { aero: pressureScale(fields), contact: contactScale(fields) } };
});

const paint = (context, box, model) => drawColumns(context, box, model, rootPx(), smallFont(), FOLDS.strip);

export function CycleStrip() {
  const now = useComputed(() => Math.floor(readout.value * MOMENTS) % MOMENTS).value;
  return html`
    <figure class="plot cycle-strip">
      <figcaption><h2>${FOLDS.strip.title}</h2><span class="when">${FOLDS.strip.scales}</span></figcaption>
      <div class="under-cursor">
        <${Picture} name="cycle-strip" title=${FOLDS.strip.title} model=${() => strip.value && { ...strip.value, colours: palette.value }} paint=${paint} label=${FOLDS.strip.picture} />
        <div class="moments" role="group" aria-label=${FOLDS.strip.title}>
          ${Array.from({ length: MOMENTS }, (_, k) => html`<button key=${k} type="button" aria-pressed=${k === now} aria-label=${FOLDS.strip.hold(Math.round(100 * phaseAt(k)))} onClick=${() => holdPhase(phaseAt(k))}></button>`)}
        </div>
      </div>
    </figure>
  `;
}
