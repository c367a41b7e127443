/**
 * The cycle matrix: one row per phase, and three columns: the folds from above with their opening, aerodynamic
 * pressure and contact pressure on the medial surface. Reads fields and scales, no state.
 */
import { smoothLine } from "../../core/canvas.js";
import { paintField } from "../../core/colours.js";
import { foldEdges } from "../../core/glottis.js";
import { fieldAt } from "../../core/result.js";

/** The layout of a matrix of `count` rows in a box: {left, columns: [{left, right}], rows: [{top, bottom}]}. */
export function matrixLayout(width, height, count, unit) {
  const left = 2.9 * unit;
  const gap = 0.6 * unit;
  const head = 1.3 * unit;
  const each = (height - head) / count;
  const wide = (width - left - 2 * gap) / 3;
  return {
    columns: [0, 1, 2].map((k) => ({ left: left + k * (wide + gap), right: left + k * (wide + gap) + wide })),
    rows: Array.from({ length: count }, (_, k) => ({
      top: head + k * each,
      bottom: head + (k + 1) * each - 0.25 * unit,
    })),
    left,
    head,
  };
}

/**
 * `phases` 0 to 1, one per row. `scales`: {aero, contact} as for a field map. `reachMm`: half the height of the shapes'
 * column. `words`: {opening, aero, contact}.
 */
export function drawCycleMatrix(context, layout, { fields, phases, scales, reachMm }, colours, font, words) {
  context.font = font;
  context.textBaseline = "top";
  context.textAlign = "left";
  context.fillStyle = colours.ink;
  [words.opening, words.aero, words.contact].forEach((text, k) => context.fillText(text, layout.columns[k].left, 1));
  phases.forEach((phase, k) => {
    const { top, bottom } = layout.rows[k];
    context.fillStyle = colours.inkSoft;
    context.textAlign = "right";
    context.textBaseline = "middle";
    context.fillText(`${Math.round(phase * 100)} %`, layout.left - 6, (top + bottom) / 2);
    drawOpening(
      context,
      { ...layout.columns[0], top, bottom },
      foldEdges(fields, fieldAt(fields, "w", phase)),
      reachMm,
      colours,
    );
    drawField(
      context,
      { ...layout.columns[1], top, bottom },
      fields,
      fieldAt(fields, "aero", phase),
      scales.aero,
      colours,
    );
    drawField(
      context,
      { ...layout.columns[2], top, bottom },
      fields,
      fieldAt(fields, "contact", phase),
      scales.contact,
      colours,
    );
  });
}

/** Both folds from above, anterior left, with the opening between them. */
export function drawOpening(context, { left, right, top, bottom }, edges, reachMm, colours) {
  const middle = (top + bottom) / 2;
  const x = (u) => left + ((u + edges.lengthMm) / edges.lengthMm) * (right - left);
  const y = (r, side) => middle + side * Math.min(Math.max(r, 0) / reachMm, 1) * ((bottom - top) / 2);
  const line = (r, side) => edges.u.map((u, i) => [x(u), y(r[i], side)]);
  context.save();
  context.beginPath();
  context.rect(left, top, right - left, bottom - top);
  context.clip();
  context.fillStyle = colours.fold;
  context.fillRect(left, top, right - left, bottom - top);
  context.beginPath();
  smoothLine(context, line(edges.superior, -1));
  smoothLine(context, line(edges.superior, 1).reverse(), { move: false });
  context.fillStyle = colours.lip;
  context.fill();
  context.beginPath();
  smoothLine(context, line(edges.inner, -1));
  smoothLine(context, line(edges.inner, 1).reverse(), { move: false });
  context.fillStyle = colours.opening;
  context.fill();
  for (const side of [-1, 1]) {
    for (const [r, dash] of [
      [edges.inferior, [3, 2.5]],
      [edges.superior, []],
    ]) {
      context.beginPath();
      smoothLine(context, line(r, side));
      context.setLineDash(dash);
      context.lineWidth = 1;
      context.strokeStyle = colours.superior;
      context.stroke();
    }
  }
  context.setLineDash([]);
  context.restore();
  frame(context, left, top, right, bottom, colours);
}

const nodes = document.createElement("canvas");

function drawField(context, { left, right, top, bottom }, fields, values, scale, colours) {
  paintField(nodes, fields, values, scale, colours.theme);
  const { nx, ny } = fields;
  context.imageSmoothingEnabled = true;
  context.imageSmoothingQuality = "high";
  // The outermost nodes lie on the edges, as in the maps of the instrument.
  context.drawImage(nodes, 0.5, 0.5, nx - 1, ny - 1, left, top, right - left, bottom - top);
  frame(context, left, top, right, bottom, colours);
}

function frame(context, left, top, right, bottom, colours) {
  context.lineWidth = 0.75;
  context.strokeStyle = colours.line;
  context.strokeRect(left, top, right - left, bottom - top);
}
