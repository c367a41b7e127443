/** Paints the folds of a stage: tissue, opening, contact, edges. Reads outlines and colours, knows no state. */
import { smoothLine } from "./canvas.js";

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

/** The static shape, as a thin line behind nothing and before everything: where the folds would rest. */
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

/** The fold's outer border: widest in the middle, carried a little by the fold's own movement. */
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
  smoothLine(context, u.map((v, i) => view.at(v, open[i])));
  smoothLine(context, u.map((v, i) => view.at(v, -open[i])).reverse(), { move: false });
  context.closePath();
  context.fillStyle = colours.opening;
  context.fill();
}

function fillBand(context, view, u, inner, outer, side, colour) {
  context.beginPath();
  smoothLine(context, u.map((v, i) => view.at(v, side * inner[i])));
  smoothLine(context, u.map((v, i) => view.at(v, side * outer[i])).reverse(), { move: false });
  context.closePath();
  context.fillStyle = colour;
  context.fill();
}

function strokeEdge(context, view, u, r, side, colour, { width, dash = [] }) {
  context.beginPath();
  smoothLine(context, u.map((v, i) => view.at(v, side * r[i])));
  context.setLineDash(dash);
  context.lineWidth = width;
  context.strokeStyle = colour;
  context.stroke();
  context.setLineDash([]);
}

/** Tissue ends at the midline: what is pressed into the other fold is told by the glow. */
function clipToSide(context, view, side) {
  context.beginPath();
  [[-60, 0], [60, 0], [60, side * 60], [-60, side * 60]].forEach(([u, r], k) => {
    if (k === 0) context.moveTo(...view.at(u, r));
    else context.lineTo(...view.at(u, r));
  });
  context.clip();
}

const GLOW_LAYERS = 6;
const GLOW_REACH_MM = [0.25, 1.5]; // half width without and at the largest pressure

/** Warm where the folds press on each other, the wider the harder; layers make its edge soft. */
function drawContact(context, view, { u }, contact, colours) {
  if (!contact.some((share) => share > 0.01)) return;
  const reach = contact.map((share) => (share > 0.01 ? GLOW_REACH_MM[0] + (GLOW_REACH_MM[1] - GLOW_REACH_MM[0]) * Math.sqrt(share) : 0));
  context.save();
  context.fillStyle = colours.glow;
  for (let layer = 1; layer <= GLOW_LAYERS; layer++) {
    const width = 1 - (layer - 1) / GLOW_LAYERS;
    context.globalAlpha = 0.1 + 0.1 * layer / GLOW_LAYERS;
    context.beginPath();
    smoothLine(context, u.map((v, i) => view.at(v, reach[i] * width)));
    smoothLine(context, u.map((v, i) => view.at(v, -reach[i] * width)).reverse(), { move: false });
    context.closePath();
    context.fill();
  }
  context.restore();
}
