/** Shapes of one fold: at rest, most open, most closed. */
import { computed, html } from "../ui.js";
import { steadyLimits } from "../plots/axis.js";
import { foldEdges, staticEdges } from "../plots/glottis.js";
import { drawShapes, extremePhases } from "../plots/shapes-draw.js";
import { palette, rootPx, smallFont } from "../plots/theme.js";
import { extent, fieldAt, isVoiced } from "../result.js";
import { posture, result } from "../state/outcome.js";
import { SHAPES } from "../texts.js";
import { Picture } from "./Picture.js";

/** Outlines at the phases of largest and smallest opening; null where nothing vibrates. */
export function extremeShapes(fields) {
  const all = Array.from({ length: fields.phases }, (_, k) => foldEdges(fields, fieldAt(fields, "w", k / fields.phases)));
  // Signed, so that of all closed moments the one pressed hardest counts as most closed.
  const { open, closed } = extremePhases(all.map((edges) => edges.inner.reduce((sum, r) => sum + r, 0)));
  return { open: all[Math.round(open * fields.phases)], closed: all[Math.round(closed * fields.phases)] };
}

const extremes = computed(() => (isVoiced(result.value) ? extremeShapes(result.value.fields) : null));

let limitsBefore;

function model() {
  if (!posture.value) return null;
  const colours = palette.value;
  const shapes = [{ edges: staticEdges(posture.value.static_shape), colour: colours.inkSoft }];
  if (extremes.value) {
    shapes.push({ edges: extremes.value.open, colour: colours.mostOpen }, { edges: extremes.value.closed, colour: colours.mostClosed });
  }
  const range = extent(shapes.flatMap(({ edges }) => [...edges.superior, ...edges.inferior]));
  limitsBefore = steadyLimits(limitsBefore, range, { least: 1 });
  return { shapes, colours, limits: { x: [0, 20], r: limitsBefore } };
}

function paint(context, size, { shapes, colours, limits }) {
  const unit = rootPx();
  const box = { left: 3.1 * unit, right: size.width - 0.5 * unit, top: 0.4 * unit, bottom: size.height - 1.35 * unit };
  drawShapes(context, box, shapes, limits, colours, smallFont(), SHAPES);
}

export function Shapes() {
  return html`
    <figure class="shapes">
      <figcaption>
        <h2>${SHAPES.title}</h2>
        <ul class="legend inline">
          ${["open", "closed", "static"].map((key) => html`<li><i class=${`key shape-${key}`}></i>${SHAPES[key]}</li>`)}
        </ul>
      </figcaption>
      <${Picture} name="shapes" title=${SHAPES.title} model=${model} paint=${paint} label=${SHAPES.picture} />
      <p class="wave-foot"><span>${SHAPES.along}</span><span>${SHAPES.edges}</span></p>
    </figure>
  `;
}
