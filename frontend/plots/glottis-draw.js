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

/** The fold's outer border: wide in the middle, carried a little by the fold's own movement. */
function lateralBorder({ u, superior, lengthMm }) {
  return u.map((position, i) => {
    const along = 1 + position / lengthMm; // 0 at the commissure, 1 at the vocal process
    const rest = 1.1 + 6.1 * Math.sin(Math.PI * Math.min(1, 0.06 + 0.8 * along)) ** 0.8;
    return Math.max(rest + 0.22 * Math.max(superior[i], 0), superior[i] + 0.9);
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

const GLOW_STEPS = 72;
const GLOW_REACH_MM = 1.7;

function drawContact(context, view, { u }, contact, colours) {
  if (!contact.some((share) => share > 0.01)) return;
  const [x0, y0] = view.at(0, -GLOW_REACH_MM);
  const [x1, y1] = view.at(0, GLOW_REACH_MM);
  const across = context.createLinearGradient(x0 === x1 ? 0 : x0, y0 === y1 ? 0 : y0, x0 === x1 ? 0 : x1, y0 === y1 ? 0 : y1);
  across.addColorStop(0, colours.glowClear);
  across.addColorStop(0.5, colours.glow);
  across.addColorStop(1, colours.glowClear);
  context.save();
  context.fillStyle = across;
  const last = u.length - 1;
  for (let k = 0; k < GLOW_STEPS; k++) {
    const from = (k / GLOW_STEPS) * last;
    const middle = from + 0.5 / GLOW_STEPS * last;
    const share = between(contact, middle);
    if (share <= 0.01) continue;
    context.globalAlpha = 0.2 + 0.8 * Math.sqrt(share);
    const reach = GLOW_REACH_MM;
    const [ax, ay] = view.at(between(u, from), -reach);
    const [bx, by] = view.at(between(u, from + last / GLOW_STEPS) + 0.02, reach);
    context.fillRect(Math.min(ax, bx), Math.min(ay, by), Math.abs(bx - ax), Math.abs(by - ay));
  }
  context.restore();
}

function between(values, position) {
  const i = Math.min(Math.floor(position), values.length - 2);
  return values[i] + (position - i) * (values[i + 1] - values[i]);
}
