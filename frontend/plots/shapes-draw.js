/** The shapes of one fold: static, most open, most closed; superior edge solid, inferior dashed. */
import { smoothLine } from "./canvas.js";
import { niceStep, tickText, ticks } from "./axis.js";

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
