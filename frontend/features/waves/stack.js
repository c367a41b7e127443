/** The stack of waves: which part of the run it shows, what is computed from it, and how it is painted. */
import { fewTicks, ticks, tickText } from "../../core/axis.js";
import { extent } from "../../core/result.js";

const WINDOW_S = 0.03;
const MOST_PERIODS_LOST = 2.2; // at least this much of a long period is shown
export const SLOPE_CUTOFF_HZ = 3000; // as for MFDR

/**
 * The part of the run on display. It ends with the highlighted cycle, which therefore stays at the right edge:
 * {startS, endS, first, last} with sample numbers of the result's own waves.
 */
export function windowOf(result) {
  const { cycle, rate, startS } = result;
  const endS = Math.min(cycle.startS + cycle.periodS, result.durationS);
  const width = Math.max(WINDOW_S, MOST_PERIODS_LOST * cycle.periodS);
  const begin = Math.max(endS - width, startS);
  const samples = result.waves.flow.length;
  return {
    startS: begin,
    endS: begin + width,
    first: Math.max(0, Math.floor((begin - startS) * rate)),
    last: Math.min(samples - 1, Math.ceil((endS - startS) * rate)),
  };
}

/** dQ/dt of a wave between two samples, smoothed by the Gaussian that MFDR uses; unit of the wave per second. */
export function slope(wave, first, last, rate) {
  const sigma = (Math.sqrt(Math.log(2)) / (2 * Math.PI * SLOPE_CUTOFF_HZ)) * rate;
  const reach = Math.ceil(5 * sigma);
  const kernel = Array.from({ length: 2 * reach + 1 }, (_, k) => Math.exp(-0.5 * ((k - reach) / sigma) ** 2));
  const sum = kernel.reduce((a, b) => a + b, 0);
  const out = new Float32Array(last - first + 1);
  const at = (k) => wave[Math.max(0, Math.min(wave.length - 1, k))];
  for (let k = first; k <= last; k++) {
    let value = 0;
    for (let m = -reach; m <= reach; m++) value -= (m / sigma ** 2) * kernel[m + reach] * at(k - m);
    out[k - first] = (value / sum) * rate;
  }
  return out;
}

/** The rows of the stack, top to bottom; `factor` converts from SI; no axis is finer than `least`. */
export const ROWS = [
  { key: "pressure", unit: "Pa", factor: 1, least: 50, symmetric: true },
  { key: "flow", unit: "mL/s", factor: 1e6, least: 100 },
  { key: "slope", unit: "L/s²", factor: 1e3, least: 100 },
  { key: "area", unit: "mm²", factor: 1e6, least: 2 },
  { key: "contact", unit: "kPa", factor: 1e-3, least: 0.2 },
];

/** The rows of a result in their units: {window, rows: [{key, unit, values, range}]}. */
export function waveRows(result) {
  const window = windowOf(result);
  const rows = ROWS.map((row) => {
    const source =
      row.key === "slope"
        ? slope(result.waves.flow, window.first, window.last, result.rate)
        : result.waves[row.key].subarray(window.first, window.last + 1);
    const values = Float32Array.from(source, (v) => v * row.factor);
    return { ...row, values, range: extent(values) };
  });
  return { window, rows };
}

/** Value of a row at an instant, or null outside it. */
export function valueAt(result, { window, rows }, index, timeS) {
  const k = Math.round((timeS - result.startS) * result.rate) - window.first;
  const values = rows[index].values;
  return k >= 0 && k < values.length ? values[k] : null;
}

/** The layout of a stack of `count` rows: {left, right, rows: [{top, bottom}], x(t), time(x)}. */
export function stackLayout(width, height, count, window, unit) {
  const left = 3.1 * unit;
  const right = width - 0.5 * unit;
  const foot = 1.35 * unit;
  const head = 1.25 * unit;
  const each = (height - foot) / count;
  const rows = Array.from({ length: count }, (_, k) => ({
    top: k * each + head,
    bottom: (k + 1) * each - 0.35 * unit,
  }));
  const span = window.endS - window.startS;
  return {
    left,
    right,
    rows,
    width,
    height,
    foot,
    x: (timeS) => left + ((timeS - window.startS) / span) * (right - left),
    time: (x) => window.startS + ((x - left) / (right - left)) * span,
  };
}

/** `limits`: one [low, high] per row. */
export function drawWaves(context, layout, result, { window, rows }, limits, colours, font) {
  highlightCycle(context, layout, result, colours);
  drawTimeAxis(context, layout, result, window, colours, font);
  rows.forEach((row, k) => {
    const place = layout.rows[k];
    const [low, high] = limits[k];
    const y = (value) => place.bottom - ((value - low) / (high - low)) * (place.bottom - place.top);
    context.font = font;
    context.textAlign = "right";
    context.textBaseline = "middle";
    const marks = fewTicks(low, high);
    for (const mark of marks) {
      context.fillStyle = colours.grid;
      context.fillRect(layout.left, Math.round(y(mark)), layout.right - layout.left, mark === 0 ? 1.25 : 0.75);
      context.fillStyle = colours.inkSoft;
      context.fillText(tickText(mark, marks[1] - marks[0]), layout.left - 5, y(mark));
    }
    drawLine(context, layout, result, row.values, window, y, colours[row.key]);
  });
}

function drawLine(context, layout, result, values, window, y, colour) {
  const startS = result.startS + window.first / result.rate;
  const pixels = layout.right - layout.left;
  context.save();
  context.beginPath();
  context.rect(layout.left, 0, pixels + 0.5, layout.height);
  context.clip();
  context.beginPath();
  // More than two points per pixel cannot be seen and only cost time.
  const stride = Math.max(1, Math.floor(values.length / (2 * pixels)));
  for (let k = 0; k < values.length; k += stride) context.lineTo(layout.x(startS + k / result.rate), y(values[k]));
  context.lineWidth = 1.5;
  context.lineJoin = "bevel";
  context.strokeStyle = colour;
  context.stroke();
  context.restore();
}

function highlightCycle(context, layout, { cycle }, colours) {
  if (!cycle.complete) return;
  const from = layout.x(cycle.startS);
  context.fillStyle = colours.cycle;
  context.fillRect(from, 0, layout.x(cycle.startS + cycle.periodS) - from, layout.height - layout.foot);
}

/** Milliseconds counted from the start of the highlighted cycle. */
function drawTimeAxis(context, layout, { cycle }, window, colours, font) {
  context.font = font;
  context.textAlign = "center";
  context.textBaseline = "top";
  const ms = (timeS) => (timeS - cycle.startS) * 1e3;
  const bottom = layout.height - layout.foot;
  for (const mark of ticks(ms(window.startS), ms(window.endS), 7)) {
    const x = layout.x(cycle.startS + mark / 1e3);
    context.fillStyle = colours.grid;
    context.fillRect(Math.round(x), 0, 0.75, bottom);
    context.fillStyle = colours.inkSoft;
    if (x > layout.left + 8 && x < layout.right - 8) context.fillText(tickText(mark, 5), x, bottom + 4);
  }
}
