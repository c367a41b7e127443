/**
 * The surroundings of the folds, as a plan: thyroid and arytenoid cartilages, and the five muscles as strands whose
 * weight is their activation. Schematic: positions follow the posture (length, half-angle), sizes are those of a
 * textbook larynx.
 */
import { smoothLine } from "../../core/canvas.js";

const SIDES = [-1, 1];
// Arytenoid in mm from the vocal process: [backwards, sideways]; it turns about its joint.
const ARYTENOID = [
  [-0.9, 0.3],
  [1.5, 0.1],
  [6.6, 0.2],
  [7.5, 1.6],
  [6.8, 4.2],
  [5.4, 6.6],
  [4.2, 6],
  [3.2, 3],
  [1.2, 1.5],
];
const JOINT = [4.9, 3.1];
const MUSCULAR_PROCESS = [5.2, 5.3];
const BACK = [6.9, 2.1];
const TURN_PER_HALF_ANGLE = 1.5; // the process swings out as the arytenoid turns about its joint

/** `lengthMm` and `halfAngleRad` of the posture; the vocal process lies L·tan(θ_g) from the midline. */
export function anatomyOf(lengthMm, halfAngleRad) {
  const out = lengthMm * Math.tan(halfAngleRad);
  const turn = -TURN_PER_HALF_ANGLE * halfAngleRad;
  const [tipU, tipR] = rotate([0, 0], turn);
  const place = (point) => {
    const [u, r] = rotate(point, turn);
    return [u - tipU, r - tipR + out];
  };
  return {
    lengthMm,
    outMm: out,
    medial: place([7, 0]),
    arytenoid: ARYTENOID.map(place),
    muscular: place(MUSCULAR_PROCESS),
    back: place(BACK),
    insertion: place([2.6, 2.2]),
  };
}

function rotate([u, r], angle) {
  const [cu, cr] = [u - JOINT[0], r - JOINT[1]];
  return [
    JOINT[0] + cu * Math.cos(angle) - cr * Math.sin(angle),
    JOINT[1] + cu * Math.sin(angle) + cr * Math.cos(angle),
  ];
}

/** Lines of each muscle on one side, mm: [[u, r], …]. */
export function strands({ lengthMm, muscular, back, insertion }) {
  const front = -lengthMm;
  return {
    ta: [[front - 0.6, 1.5], [front * 0.62, 5.3], [front * 0.28, 5.2], insertion],
    lca: [[front * 0.42, 9.1], [-1.5, 8.3], muscular],
    pca: [[9.6, 0.9], [8.6, 3.2], muscular],
    ia: [[back[0] + 0.3, 0], back],
    ct: [
      [-7.2, 10.2],
      [front * 0.72, 9.9],
      [front - 0.4, 5.2],
    ],
  };
}

export function drawBackdrop(context, view, anatomy, colours) {
  const front = -anatomy.lengthMm;
  const wall = [
    [front - 1.4, 0],
    [front + 1.2, 3.2],
    [front * 0.55, 7.6],
    [-1, 8.7],
    [5, 8.1],
    [8.3, 4.6],
    [8.9, 0],
  ];
  context.beginPath();
  smoothLine(
    context,
    wall.map(([u, r]) => view.at(u, r)),
  );
  smoothLine(context, wall.map(([u, r]) => view.at(u, -r)).reverse(), { move: false });
  context.closePath();
  context.fillStyle = colours.wall;
  context.fill();
}

/** The model has no moving tissue between the arytenoids; an open gap there is paler than the glottis. */
export function drawPosteriorGap(context, view, anatomy, colours) {
  const edge = [
    [0, anatomy.outMm],
    [anatomy.medial[0], anatomy.medial[1]],
  ];
  const outline = [...edge, ...edge.map(([u, r]) => [u, -r]).reverse()];
  context.beginPath();
  outline.forEach(([u, r], k) => (k === 0 ? context.moveTo(...view.at(u, r)) : context.lineTo(...view.at(u, r))));
  context.closePath();
  context.fillStyle = colours.openingPale;
  context.fill();
}

export function drawCartilages(context, view, anatomy, colours) {
  context.lineJoin = context.lineCap = "round";
  const front = -anatomy.lengthMm - 2.3;
  const lamina = (side) => [
    [front, 0],
    [front + 1.5, 2.6 * side],
    [front + 6, 7.4 * side],
    [front + 13, 13.6 * side],
  ];
  context.beginPath();
  smoothLine(
    context,
    [...lamina(-1).reverse(), ...lamina(1).slice(1)].map(([u, r]) => view.at(u, r)),
  );
  for (const [colour, width] of [
    [colours.cartilageEdge, 1.5 * view.scale + 2],
    [colours.cartilage, 1.5 * view.scale],
  ]) {
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.stroke();
  }
  for (const side of SIDES) {
    context.beginPath();
    const points = anatomy.arytenoid.map(([u, r]) => view.at(u, Math.max(r, 0.08) * side));
    roundedOutline(context, points);
    context.fillStyle = colours.cartilage;
    context.fill();
    context.lineWidth = 1;
    context.strokeStyle = colours.cartilageEdge;
    context.stroke();
  }
}

/** A closed outline through the middles of the sides, bending at the corners. */
function roundedOutline(context, points) {
  const middle = (a, b) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  context.moveTo(...middle(points.at(-1), points[0]));
  points.forEach((corner, k) =>
    context.quadraticCurveTo(...corner, ...middle(corner, points[(k + 1) % points.length])),
  );
  context.closePath();
}

/** `activation`: {ta: 0.4, …}. */
export function drawMuscles(context, view, anatomy, activation, colours) {
  const lines = strands(anatomy);
  context.lineCap = "round";
  for (const [name, points] of Object.entries(lines)) {
    const level = Math.max(0, Math.min(1, activation[name] ?? 0));
    for (const side of SIDES) {
      context.beginPath();
      smoothLine(
        context,
        points.map(([u, r]) => view.at(u, r * side)),
      );
      context.globalAlpha = 0.35 + 0.55 * level;
      context.lineWidth = (0.25 + 0.75 * level) * view.scale;
      context.strokeStyle = colours[name];
      context.stroke();
      context.globalAlpha = 1;
    }
  }
}
