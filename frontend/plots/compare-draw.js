/** Paints the cycles of A and B, overlaid in two hues that never change their meaning, or B − A. */
import { niceCeil } from "./axis.js";
import { COMPARED, difference } from "./compare.js";
import { drawFrame, strokePoints } from "./frame-draw.js";

/** `a`, `b`: rows of compare.js, either may be null; `mode`: both | difference. */
export function drawComparison(context, box, { a, b, mode, colours, names }, unit, font, words) {
  const gap = 0.5 * unit;
  const foot = 1.6 * unit;
  const height = (box.height - foot) / COMPARED.length;
  COMPARED.forEach(({ key, unit: of }, row) => {
    const lines = mode === "difference" ? (a && b ? [[difference(a[key], b[key]), colours.mostOpen]] : []) : [[a?.[key], colours.voiceA], [b?.[key], colours.voiceB]];
    const shown = lines.filter(([values]) => values);
    const all = shown.flatMap(([values]) => [...values]);
    const low = -niceCeil(-Math.min(0, ...all));
    const high = niceCeil(Math.max(0, ...all)) || 1;
    const field = { left: 2.9 * unit, right: box.width - 0.7 * unit, top: row * height + 1.35 * unit, bottom: (row + 1) * height - gap };
    const last = row === COMPARED.length - 1;
    const { x, y, inside } = drawFrame(
      context, field, { x: { limits: [0, 1], label: "", most: last ? 5 : 0 }, y: { limits: [low || 0, high], label: `${names[key]}, ${of}`, most: 3 } }, colours, font,
    ); // prettier-ignore
    inside(() => {
      for (const [values, colour] of shown) strokePoints(context, Array.from(values, (v, k) => [x(k / (values.length - 1)), y(v)]), colour, { width: 1.9 });
    });
  });
  context.font = font;
  context.textAlign = "right";
  context.textBaseline = "bottom";
  context.fillStyle = colours.inkSoft;
  context.fillText(words.cycle, box.width - 0.7 * unit, box.height - 1);
}
