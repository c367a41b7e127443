/** Shapes of one fold: at rest, most open, most closed. Superior edge solid, inferior dashed. */
import { computed, html } from "../../core/ui.js";
import { niceStep, steadyLimits, ticks, tickText } from "../../core/axis.js";
import { smoothLine } from "../../core/canvas.js";
import { foldEdges, staticEdges } from "../../core/glottis.js";
import { Picture } from "../../core/picture.js";
import { extent, fieldAt, isVoiced } from "../../core/result.js";
import { palette, rootPx, smallFont } from "../../core/theme.js";
import { posture, result } from "../../state/answers.js";
import { SHAPES } from "./texts.js";

/** `shapes`: [{edges, colour}] with edges in mm; limits in mm. */
export function drawShapes(context, box, shapes, { x: [x0, x1], r: [r0, r1] }, colours, font, words) {
  const px = (u) => box.left + ((u - x0) / (x1 - x0)) * (box.right - box.left);
  const py = (r) => box.top + ((r1 - r) / (r1 - r0)) * (box.bottom - box.top);
  context.font = font;
  context.textBaseline = "middle";
  context.textAlign = "right";
  for (const mark of ticks(r0, r1, 4)) {
    context.fillStyle = colours.grid;
    context.fillRect(box.left, Math.round(py(mark)), box.right - box.left, 0.75);
    context.fillStyle = colours.inkSoft;
    context.fillText(tickText(mark, niceStep(r1 - r0, 4)), box.left - 5, py(mark));
  }
  context.textBaseline = "top";
  context.textAlign = "center";
  for (const mark of ticks(x0, x1, 5)) context.fillText(tickText(mark, 5), px(mark), box.bottom + 4);
  context.fillStyle = colours.medial;
  context.fillRect(box.left, py(0) - 0.6, box.right - box.left, 1.2);
  context.textAlign = "left";
  context.fillText(words.axis, box.left + 3, box.top - 2);
  context.textAlign = "right";
  context.textBaseline = "bottom";
  context.fillText(words.medial, box.right - 2, py(0) - 2);
  context.save();
  context.beginPath();
  context.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
  context.clip();
  for (const { edges, colour } of shapes) {
    const points = (r) => edges.u.map((u, i) => [px(u + edges.lengthMm), py(r[i])]);
    trace(context, points(edges.inferior), colour, [4, 3.5], 1.4);
    trace(context, points(edges.superior), colour, [], 1.8);
  }
  context.restore();
}

function trace(context, points, colour, dash, width) {
  context.beginPath();
  smoothLine(context, points);
  context.setLineDash(dash);
  context.lineWidth = width;
  context.strokeStyle = colour;
  context.stroke();
  context.setLineDash([]);
}

/** Phases (0 to 1) at which the glottis is most open and most closed, by area from above. */
export function extremePhases(areas) {
  let open = 0;
  let closed = 0;
  areas.forEach((area, k) => {
    if (area > areas[open]) open = k;
    if (area < areas[closed]) closed = k;
  });
  return { open: open / areas.length, closed: closed / areas.length };
}

/** Outlines at the phases of largest and smallest opening; null where nothing vibrates. */
export function extremeShapes(fields) {
  const all = Array.from({ length: fields.phases }, (_, k) =>
    foldEdges(fields, fieldAt(fields, "w", k / fields.phases)),
  );
  // Signed: among the closed moments the one with the strongest compression counts as most closed.
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
    shapes.push(
      { edges: extremes.value.open, colour: colours.mostOpen },
      { edges: extremes.value.closed, colour: colours.mostClosed },
    );
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
          ${["open", "closed", "static"].map(
            (key) => html`
              <li>
                <i class=${`key shape-${key}`}></i>
                ${SHAPES[key]}
              </li>
            `,
          )}
        </ul>
      </figcaption>
      <${Picture} name="shapes" title=${SHAPES.title} model=${model} paint=${paint} label=${SHAPES.picture} />
      <p class="wave-foot">
        <span>${SHAPES.along}</span>
        <span>${SHAPES.edges}</span>
      </p>
    </figure>
  `;
}
