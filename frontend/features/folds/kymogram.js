/**
 * Kymogram and glottovibrogram: computed from the fields of a cycle, painted over two cycles with time to the right.
 */
import { colourWriter } from "../../core/colours.js";
import { drawFrame, fieldIn, strokePoints } from "../../core/plot-frame.js";

/** Fractions of the length at which kymograms are usually read, anterior 0. */
export const LEVELS = [0.2, 0.35, 0.5, 0.65, 0.8];

export const CYCLES = 2;

/**
 * One fold along a line across the glottis at `level` of the length, for each stored phase: distances from the midline
 * in mm {superior, inferior, inner}, and the contact pressure there, Pa.
 */
export function kymogramOf({ phases, nx, ny, medial, w, contact }, level) {
  const position = level * (nx - 1);
  const first = Math.min(Math.floor(position), nx - 2);
  const share = position - first;
  const between = (values, from, j) =>
    values[from + first * ny + j] * (1 - share) + values[from + (first + 1) * ny + j] * share;
  const lines = { superior: [], inferior: [], inner: [], contact: [] };
  for (let p = 0; p < phases; p++) {
    const from = p * nx * ny;
    let inner = Infinity;
    let pressed = 0;
    for (let j = 0; j < ny; j++) {
      const r = 1e3 * (between(medial, 0, j) - between(w, from, j));
      if (j === 0) lines.superior.push(r);
      if (j === ny - 1) lines.inferior.push(r);
      inner = Math.min(inner, r);
      pressed = Math.max(pressed, between(contact, from, j));
    }
    lines.inner.push(inner);
    lines.contact.push(pressed);
  }
  return lines;
}

/** Width of the glottis, mm, shape (phases, nx): twice the least distance from the midline, never below 0. */
export function vibrogramOf({ phases, nx, ny, medial, w }) {
  const width = new Float32Array(phases * nx);
  for (let p = 0; p < phases; p++) {
    for (let i = 0; i < nx; i++) {
      let inner = Infinity;
      for (let j = 0; j < ny; j++) inner = Math.min(inner, medial[i * ny + j] - w[p * nx * ny + i * ny + j]);
      width[p * nx + i] = 2e3 * Math.max(inner, 0);
    }
  }
  return width;
}

export const foldsField = (box, unit) => fieldIn(box, unit);

/** `lines`: of kymogramOf; `limit`: mm on both sides. */
export function drawKymogram(context, box, { lines, limit, colours, xLabel }, unit, font, words) {
  const field = foldsField(box, unit);
  const axes = {
    x: { limits: [0, CYCLES], label: xLabel, most: 4 },
    y: { limits: [-limit, limit], label: words.lateral },
  };
  const { x, y, inside } = drawFrame(context, field, axes, colours, font);
  const phases = lines.inner.length;
  const times = Array.from({ length: CYCLES * phases + 1 }, (_, k) => [x(k / phases), k % phases]);
  inside(() => {
    context.fillStyle = colours.opening;
    context.fillRect(field.left, field.top, field.right - field.left, field.bottom - field.top);
    for (const side of [-1, 1]) {
      const edge = side * limit;
      fill(
        context,
        times.map(([t, k]) => [t, y(side * Math.max(lines.inner[k], 0))]),
        y(edge),
        colours.lip,
      );
      fill(
        context,
        times.map(([t, k]) => [t, y(side * Math.max(lines.superior[k], 0))]),
        y(edge),
        colours.fold,
      );
      const seen = (values) => times.map(([t, k]) => [t, values[k] >= 0 ? y(side * values[k]) : NaN]);
      strokePoints(context, seen(lines.inferior), colours.inferior, { width: 1.2, dash: [4, 3.5] });
      strokePoints(context, seen(lines.superior), colours.superior, { width: 1.7 });
    }
    const most = Math.max(...lines.contact);
    if (most > 0)
      strokePoints(
        context,
        times.map(([t, k]) => [t, lines.contact[k] > 0.01 * most ? y(0) : NaN]),
        colours.glow,
        { width: 5 },
      );
  });
}

function fill(context, points, base, colour) {
  context.beginPath();
  context.moveTo(points[0][0], base);
  for (const point of points) context.lineTo(...point);
  context.lineTo(points.at(-1)[0], base);
  context.closePath();
  context.fillStyle = colour;
  context.fill();
}

/** `width` (phases, nx) in mm; anterior on top. */
export function drawVibrogram(context, box, { width, phases, nx, limit, colours, xLabel }, unit, font, words) {
  const field = foldsField(box, unit);
  const axes = { x: { limits: [0, CYCLES], label: xLabel, most: 4 }, y: { limits: [1, 0], label: words.along } };
  const { inside } = drawFrame(context, field, axes, colours, font);
  inside(() => {
    const canvas = document.createElement("canvas");
    canvas.width = CYCLES * phases;
    canvas.height = nx;
    const inner = canvas.getContext("2d");
    const image = inner.createImageData(canvas.width, nx);
    const write = colourWriter({ kind: "below", limit }, colours.theme);
    for (let k = 0; k < canvas.width; k++) {
      for (let i = 0; i < nx; i++) {
        const pixel = 4 * (i * canvas.width + k);
        write(width[(k % phases) * nx + i], image.data, pixel);
        image.data[pixel + 3] = 255;
      }
    }
    inner.putImageData(image, 0, 0);
    context.drawImage(canvas, field.left, field.top, field.right - field.left, field.bottom - field.top);
  });
}
