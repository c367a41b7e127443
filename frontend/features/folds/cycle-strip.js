/**
 * Moments of a cycle, or two voices at one moment, in columns: the glottis from above, and the pressures on the medial
 * surface below it.
 */
import { computed, html, useComputed } from "../../core/ui.js";
import { paintField } from "../../core/colours.js";
import { foldEdges } from "../../core/glottis.js";
import { Picture } from "../../core/picture.js";
import { strokePoints } from "../../core/plot-frame.js";
import { fieldAt, isVoiced } from "../../core/result.js";
import { palette, rootPx, smallFont } from "../../core/theme.js";
import { holdPhase, readout } from "../../state/motion.js";
import { settled } from "../../state/settled.js";
import { FOLDS } from "./texts.js";
import { contactScale, pressureScale } from "../surface/view.js";

export const MOMENTS = 6;

/** Phase of column `k`, 0 to 1: the middle of its sixth of the cycle. */
export const phaseAt = (k) => (k + 0.5) / MOMENTS;

/** The contents of one column: a voice at a phase. */
export const columnOf = (fields, phase, label) => ({
  fields,
  label,
  edges: foldEdges(fields, fieldAt(fields, "w", phase)),
  aero: fieldAt(fields, "aero", phase),
  contact: fieldAt(fields, "contact", phase),
});

/** `columns`: of columnOf; `scales`: {aero, contact}; `reach`, `long`: mm shown across and along the midline. */
export function drawColumns(context, box, { columns, scales, reach, long = null, colours }, unit, font, words) {
  const left = 2.9 * unit;
  const each = (box.width - left - 0.7 * unit) / columns.length;
  const foot = 1.2 * unit;
  const high = (box.height - foot) / 3;
  const gap = 0.25 * unit;
  context.font = font;
  context.textBaseline = "middle";
  context.textAlign = "left";
  context.fillStyle = colours.inkSoft;
  [words.above, words.aero, words.contact].forEach((text, row) => context.fillText(text, 2, (row + 0.5) * high));
  columns.forEach(({ fields, label, colour, edges, aero, contact }, k) => {
    const x = left + k * each;
    drawOpening(
      context,
      { x, y: 0, width: each - gap, height: high - gap },
      edges,
      { reach, long: long ?? edges.lengthMm },
      colours,
    );
    [
      ["aero", aero],
      ["contact", contact],
    ].forEach(([name, values], row) => {
      const canvas = document.createElement("canvas");
      paintField(canvas, fields, values, scales[name], colours.theme);
      context.drawImage(canvas, x, (row + 1) * high, each - gap, high - gap);
    });
    context.textAlign = "center";
    context.fillStyle = colour ?? colours.inkSoft;
    context.fillText(label, x + (each - gap) / 2, box.height - foot / 2);
  });
}

function drawOpening(context, { x, y, width, height }, { u, inner, superior, inferior }, { reach, long }, colours) {
  context.save();
  context.beginPath();
  context.rect(x, y, width, height);
  context.clip();
  context.fillStyle = colours.fold;
  context.fillRect(x, y, width, height);
  const at = (r, i) => [x + (1 + u[i] / long) * width, y + height / 2 - (r / reach) * (height / 2)];
  const open = inner.map((r) => Math.max(r, 0));
  context.beginPath();
  open.forEach((r, i) => context.lineTo(...at(r, i)));
  open
    .map((r, i) => at(-r, i))
    .reverse()
    .forEach((point) => context.lineTo(...point));
  context.closePath();
  context.fillStyle = colours.opening;
  context.fill();
  for (const side of [-1, 1]) {
    const line = (values) => values.map((r, i) => (r >= 0 ? at(side * r, i) : [0, NaN]));
    strokePoints(context, line(inferior), colours.inferior, { width: 1, dash: [3, 2.5] });
    strokePoints(context, line(superior), colours.superior, { width: 1.3 });
  }
  context.restore();
}

const strip = computed(() => {
  if (!isVoiced(settled.value)) return null;
  const { fields } = settled.value;
  const columns = Array.from({ length: MOMENTS }, (_, k) =>
    columnOf(fields, phaseAt(k), FOLDS.strip.moment(Math.round(100 * phaseAt(k)))),
  );
  const reach = Math.max(1, ...columns.flatMap(({ edges }) => [...edges.superior, ...edges.inferior]));
  return { columns, reach, scales: { aero: pressureScale(fields), contact: contactScale(fields) } };
});

const paint = (context, box, model) => drawColumns(context, box, model, rootPx(), smallFont(), FOLDS.strip);

export function CycleStrip() {
  const now = useComputed(() => Math.floor(readout.value * MOMENTS) % MOMENTS).value;
  return html`
    <figure class="plot cycle-strip">
      <figcaption>
        <h2>${FOLDS.strip.title}</h2>
        <span class="when">${FOLDS.strip.scales}</span>
      </figcaption>
      <div class="under-cursor">
        <${Picture}
          name="cycle-strip"
          title=${FOLDS.strip.title}
          model=${() => strip.value && { ...strip.value, colours: palette.value }}
          paint=${paint}
          label=${FOLDS.strip.picture}
        />
        <div class="moments" role="group" aria-label=${FOLDS.strip.title}>
          ${Array.from(
            { length: MOMENTS },
            (_, k) => html`
              <button
                key=${k}
                type="button"
                aria-pressed=${k === now}
                aria-label=${FOLDS.strip.hold(Math.round(100 * phaseAt(k)))}
                onClick=${() => holdPhase(phaseAt(k))}
              ></button>
            `,
          )}
        </div>
      </div>
    </figure>
  `;
}
