/** Six moments of the cycle side by side: the glottis from above, pressures on the medial surface below it. */
import { paintField } from "./map-image.js";
import { strokePoints } from "./frame-draw.js";

export const MOMENTS = 6;

/** Phase of column `k`, 0 to 1: the middle of its sixth of the cycle. */
export const phaseAt = (k) => (k + 0.5) / MOMENTS;

/** Left edge and width of the columns, px. */
function columnsIn(box, unit) {
  const left = 2.9 * unit;
  return { left, each: (box.width - left - 0.7 * unit) / MOMENTS };
}

/** `columns`: [{edges, aero, contact}] at the phases above; `scales`: {aero, contact}; `reach`: mm shown beside the midline. */
export function drawCycleStrip(context, box, { columns, fields, scales, reach, colours }, unit, font, words) {
  const { left, each } = columnsIn(box, unit);
  const foot = 1.2 * unit;
  const high = (box.height - foot) / 3;
  const gap = 0.25 * unit;
  context.font = font;
  context.textBaseline = "middle";
  context.textAlign = "left";
  context.fillStyle = colours.inkSoft;
  [words.above, words.aero, words.contact].forEach((text, row) => context.fillText(text, 2, (row + 0.5) * high));
  columns.forEach(({ edges, aero, contact }, k) => {
    const x = left + k * each;
    drawOpening(context, { x, y: 0, width: each - gap, height: high - gap }, edges, reach, colours);
    [["aero", aero], ["contact", contact]].forEach(([name, values], row) => {
      const canvas = document.createElement("canvas");
      paintField(canvas, fields, values, scales[name], colours.theme);
      context.drawImage(canvas, x, (row + 1) * high, each - gap, high - gap);
    });
    context.textAlign = "center";
    context.fillStyle = colours.inkSoft;
    context.fillText(`${Math.round(100 * phaseAt(k))} %`, x + (each - gap) / 2, box.height - foot / 2);
  });
}

function drawOpening(context, { x, y, width, height }, { u, inner, superior, inferior, lengthMm }, reach, colours) {
  context.save();
  context.beginPath();
  context.rect(x, y, width, height);
  context.clip();
  context.fillStyle = colours.fold;
  context.fillRect(x, y, width, height);
  const at = (r, i) => [x + (1 + u[i] / lengthMm) * width, y + height / 2 - (r / reach) * (height / 2)];
  const open = inner.map((r) => Math.max(r, 0));
  context.beginPath();
  open.forEach((r, i) => context.lineTo(...at(r, i)));
  open.map((r, i) => at(-r, i)).reverse().forEach((point) => context.lineTo(...point));
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
