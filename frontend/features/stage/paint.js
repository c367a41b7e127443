/**
 * Paints the folds on the stage (tissue, opening, contact, edges), its words and its scale. Reads outlines and
 * colours, no state.
 */
import { smoothLine } from "../../core/canvas.js";

const EXTENT = {
  anatomy: { front: -23.4, back: 10.2, side: 11.2 },
  folds: { front: -21, back: 3.2, side: 8.2 },
};

const WORDS_PX = 18; // for "Anterior" and "Posterior" at the ends

/**
 * The view of a stage of `width` by `height`: {scale px/mm, at(u, r) → [x, y]}. Anterior is left, or at the top as in
 * an endoscope.
 */
export function stageView(width, height, orientation, withAnatomy) {
  const { front, back, side } = withAnatomy ? EXTENT.anatomy : EXTENT.folds;
  const middle = (front + back) / 2;
  if (orientation === "endoscope") {
    const scale = Math.min((height - 2 * WORDS_PX) / (back - front), width / (2 * side));
    return { scale, at: (u, r) => [width / 2 + r * scale, height / 2 + (u - middle) * scale] };
  }
  const scale = Math.min((width - 2 * WORDS_PX) / (back - front), height / (2 * side));
  return { scale, at: (u, r) => [width / 2 + (u - middle) * scale, height / 2 + r * scale] };
}

const SIDES = [-1, 1];

/**
 * The moving folds. `contact` is the share 0 to 1 of the cycle's largest contact pressure at each x.
 */
export function drawFolds(context, view, edges, contact, colours) {
  const lateral = lateralBorder(edges);
  fillOpening(context, view, edges, colours);
  for (const side of SIDES) {
    context.save();
    clipToSide(context, view, side);
    fillBand(context, view, edges.u, edges.inner, lateral, side, colours.lip);
    fillBand(context, view, edges.u, edges.superior, lateral, side, colours.fold);
    context.restore();
  }
  drawContact(context, view, edges, contact, colours);
  for (const side of SIDES) {
    context.save();
    clipToSide(context, view, side);
    strokeEdge(context, view, edges.u, edges.inferior, side, colours.inferior, { width: 1.4, dash: [5, 4] });
    strokeEdge(context, view, edges.u, edges.superior, side, colours.superior, { width: 2 });
    context.restore();
  }
}

/** The static shape as a thin line in front of everything: the position of the folds at rest. */
export function drawGhost(context, view, edges, colours) {
  for (const side of SIDES) {
    context.save();
    clipToSide(context, view, side);
    strokeEdge(context, view, edges.u, edges.superior, side, colours.ghost, { width: 1.25, dash: [1.5, 3] });
    context.restore();
  }
}

export function drawMidline(context, view, edges, colours) {
  context.beginPath();
  context.moveTo(...view.at(-edges.lengthMm - 1.5, 0));
  context.lineTo(...view.at(1.5, 0));
  context.lineWidth = 0.75;
  context.strokeStyle = colours.medial;
  context.stroke();
}

/** The outer border of the fold: widest in the middle, moved a little by the fold. */
function lateralBorder({ u, superior, lengthMm }) {
  return u.map((position, i) => {
    const along = 1 + position / lengthMm; // 0 at the commissure, 1 at the vocal process
    const rest = 0.4 + 6.7 * Math.sin(Math.PI * 0.985 * along) ** 0.75;
    return Math.max(rest + 0.22 * Math.max(superior[i], 0), superior[i] + 0.4 + 0.6 * Math.sin(Math.PI * along));
  });
}

function fillOpening(context, view, { u, inner }, colours) {
  context.beginPath();
  const open = inner.map((r) => Math.max(r, 0));
  smoothLine(
    context,
    u.map((v, i) => view.at(v, open[i])),
  );
  smoothLine(context, u.map((v, i) => view.at(v, -open[i])).reverse(), { move: false });
  context.closePath();
  context.fillStyle = colours.opening;
  context.fill();
}

function fillBand(context, view, u, inner, outer, side, colour) {
  context.beginPath();
  smoothLine(
    context,
    u.map((v, i) => view.at(v, side * inner[i])),
  );
  smoothLine(context, u.map((v, i) => view.at(v, side * outer[i])).reverse(), { move: false });
  context.closePath();
  context.fillStyle = colour;
  context.fill();
}

function strokeEdge(context, view, u, r, side, colour, { width, dash = [] }) {
  context.beginPath();
  smoothLine(
    context,
    u.map((v, i) => view.at(v, side * r[i])),
  );
  context.setLineDash(dash);
  context.lineWidth = width;
  context.strokeStyle = colour;
  context.stroke();
  context.setLineDash([]);
}

/** Tissue ends at the midline; the glow shows how hard it is pressed into the other fold. */
function clipToSide(context, view, side) {
  context.beginPath();
  [
    [-60, 0],
    [60, 0],
    [60, side * 60],
    [-60, side * 60],
  ].forEach(([u, r], k) => {
    if (k === 0) context.moveTo(...view.at(u, r));
    else context.lineTo(...view.at(u, r));
  });
  context.clip();
}

const GLOW_LAYERS = 6;
const GLOW_REACH_MM = [0.25, 1.5]; // half width without and at the largest pressure

/** Warm where the folds press on each other, wider at higher pressure; layers soften its edge. */
function drawContact(context, view, { u }, contact, colours) {
  if (!contact.some((share) => share > 0.01)) return;
  const reach = contact.map((share) =>
    share > 0.01 ? GLOW_REACH_MM[0] + (GLOW_REACH_MM[1] - GLOW_REACH_MM[0]) * Math.sqrt(share) : 0,
  );
  context.save();
  context.fillStyle = colours.glow;
  for (let layer = 1; layer <= GLOW_LAYERS; layer++) {
    const width = 1 - (layer - 1) / GLOW_LAYERS;
    context.globalAlpha = 0.1 + (0.1 * layer) / GLOW_LAYERS;
    context.beginPath();
    smoothLine(
      context,
      u.map((v, i) => view.at(v, reach[i] * width)),
    );
    smoothLine(context, u.map((v, i) => view.at(v, -reach[i] * width)).reverse(), { move: false });
    context.closePath();
    context.fill();
  }
  context.restore();
}

const BAR_MM = 5;

export function drawWords(context, view, box, words, orientation, colours, font) {
  context.font = font;
  context.fillStyle = colours.inkSoft;
  context.textBaseline = "middle";
  if (orientation === "endoscope") {
    context.textAlign = "center";
    context.fillText(words.anterior, box.width / 2, 12);
    context.fillText(words.posterior, box.width / 2, box.height - 12);
  } else {
    context.textAlign = "center";
    drawTurned(context, words.anterior, 8, box.height / 2, -Math.PI / 2);
    drawTurned(context, words.posterior, box.width - 8, box.height / 2, Math.PI / 2);
  }
}

function drawTurned(context, text, x, y, angle) {
  context.save();
  context.translate(x, y);
  context.rotate(angle);
  context.fillText(text, 0, 0);
  context.restore();
}

/** Abbreviations next to the strands of one side; `names`: {ta: "TA", …}. */
export function drawMuscleNames(context, view, lines, names, colours, font) {
  context.font = font;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineJoin = "round";
  for (const [key, [along, offset]] of Object.entries(NAME_PLACES)) {
    const points = lines[key];
    const [u, r] = points[Math.min(along, points.length - 1)];
    const [x, y] = view.at(u + offset[0], -(r + offset[1]));
    context.lineWidth = 4;
    context.strokeStyle = colours.panel;
    context.strokeText(names[key], x, y);
    context.fillStyle = colours[key];
    context.fillText(names[key], x, y);
  }
}

// The point of a strand that carries its name, and the offset of the name from it, mm.
/** @type {Record<string, [number, [number, number]]>} */
const NAME_PLACES = {
  ta: [1, [0, 0.95]],
  lca: [1, [1.2, 1.1]],
  pca: [1, [1.3, 2.4]],
  ia: [0, [1.6, 0]],
  ct: [1, [-2.1, 0.7]],
};

/** A bar of 5 mm in the lower right corner. */
export function drawScaleBar(context, view, box, colours, font) {
  const length = BAR_MM * view.scale;
  const x = box.width - 14;
  const y = box.height - 14;
  context.strokeStyle = colours.ink;
  context.lineWidth = 1.5;
  context.lineCap = "butt";
  context.beginPath();
  context.moveTo(x - length, y - 4);
  context.lineTo(x - length, y);
  context.lineTo(x, y);
  context.lineTo(x, y - 4);
  context.stroke();
  context.font = font;
  context.fillStyle = colours.ink;
  context.textAlign = "center";
  context.textBaseline = "bottom";
  context.fillText(`${BAR_MM} mm`, x - length / 2, y - 5);
}
