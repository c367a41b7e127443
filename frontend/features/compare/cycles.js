/** One cycle of each of two voices on a common axis, overlaid in two fixed hues, or their difference B − A. */
import { niceCeil } from "../../core/axis.js";
import { drawFrame, strokePoints } from "../../core/plot-frame.js";
import { slope } from "../waves/stack.js";

const POINTS = 240;

export const COMPARED = [
  { key: "flow", unit: "mL/s", factor: 1e6 },
  { key: "slope", unit: "L/s²", factor: 1e3 },
  { key: "area", unit: "mm²", factor: 1e6 },
  { key: "contact", unit: "kPa", factor: 1e-3 },
];

/**
 * The rows of COMPARED over the stored cycle, POINTS values each in the unit shown; null where nothing vibrates.
 * The cycle starts where the area falls fastest: the moment of closing.
 */
export function cycleOf(result) {
  if (result.state === "none") return null;
  const { cycle, rate, startS, waves } = result;
  const first = (cycle.startS - startS) * rate;
  const length = cycle.periodS * rate;
  const last = waves.flow.length - 1;
  const from = Math.max(0, Math.floor(first));
  const to = Math.min(last, Math.ceil(first + length));
  const sources = { ...waves, slope: slope(waves.flow, from, to, rate) };
  const sample = (key) => {
    const values = sources[key];
    const shift = key === "slope" ? from : 0;
    const end = values.length - 1;
    return Float64Array.from({ length: POINTS }, (_, k) => {
      const at = Math.max(0, Math.min(end, first + (k / POINTS) * length - shift));
      const i = Math.min(Math.floor(at), end - 1);
      return values[i] + (at - i) * (values[i + 1] - values[i]);
    });
  };
  const area = sample("area");
  let closing = 0;
  const fall = (k) => area[k] - area[(k + 1) % POINTS];
  for (let k = 1; k < POINTS; k++) if (fall(k) > fall(closing)) closing = k;
  return Object.fromEntries(
    COMPARED.map(({ key, factor }) => {
      const values = sample(key);
      return [key, Float64Array.from({ length: POINTS }, (_, k) => factor * values[(k + closing) % POINTS])];
    }),
  );
}

/** b − a, value by value. */
export const difference = (a, b) => b.map((value, k) => value - a[k]);

/** `a`, `b`: rows of cycleOf, either may be null; `mode`: both | difference. */
export function drawComparison(context, box, { a, b, mode, colours, names }, unit, font, words) {
  const gap = 0.5 * unit;
  const foot = 1.6 * unit;
  const height = (box.height - foot) / COMPARED.length;
  COMPARED.forEach(({ key, unit: of }, row) => {
    const lines =
      mode === "difference"
        ? a && b
          ? [[difference(a[key], b[key]), colours.mostOpen]]
          : []
        : [
            [a?.[key], colours.voiceA],
            [b?.[key], colours.voiceB],
          ];
    const shown = lines.filter(([values]) => values);
    const all = shown.flatMap(([values]) => [...values]);
    const low = -niceCeil(-Math.min(0, ...all));
    const high = niceCeil(Math.max(0, ...all)) || 1;
    const field = {
      left: 2.9 * unit,
      right: box.width - 0.7 * unit,
      top: row * height + 1.35 * unit,
      bottom: (row + 1) * height - gap,
    };
    const last = row === COMPARED.length - 1;
    const { x, y, inside } = drawFrame(
      context,
      field,
      {
        x: { limits: [0, 1], label: "", most: last ? 5 : 0 },
        y: { limits: [low || 0, high], label: `${names[key]}, ${of}`, most: 3 },
      },
      colours,
      font,
    );
    inside(() => {
      for (const [values, colour] of shown)
        strokePoints(
          context,
          Array.from(values, (v, k) => [x(k / (values.length - 1)), y(v)]),
          colour,
          { width: 1.9 },
        );
    });
  });
  context.font = font;
  context.textAlign = "right";
  context.textBaseline = "bottom";
  context.fillStyle = colours.inkSoft;
  context.fillText(words.cycle, box.width - 0.7 * unit, box.height - 1);
}
