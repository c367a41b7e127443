/** The stack of waves: which stretch of the run is shown, and what is computed from it. Pure. */
import { extent } from "../result.js";

const WINDOW_S = 0.03;
const MOST_PERIODS_LOST = 2.2; // of a long pattern, so much must still fit
export const SLOPE_CUTOFF_HZ = 3000; // as for MFDR

/**
 * The stretch shown: it ends with the highlighted cycle, so that this one stands still at the right edge.
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

/** What the stack shows, top to bottom; `factor` turns SI into the unit shown; no axis is finer than `least`. */
export const ROWS = [
  { key: "pressure", unit: "Pa", factor: 1, least: 50, symmetric: true },
  { key: "flow", unit: "mL/s", factor: 1e6, least: 100 },
  { key: "slope", unit: "L/s²", factor: 1e3, least: 100 },
  { key: "area", unit: "mm²", factor: 1e6, least: 2 },
  { key: "contact", unit: "kPa", factor: 1e-3, least: 0.2 },
]; // prettier-ignore

/** The rows of a result in their units: {window, rows: [{key, unit, values, range}]}. */
export function waveRows(result) {
  const window = windowOf(result);
  const rows = ROWS.map((row) => {
    const source = row.key === "slope"
      ? slope(result.waves.flow, window.first, window.last, result.rate)
      : result.waves[row.key].subarray(window.first, window.last + 1);
    const values = Float32Array.from(source, (v) => v * row.factor);
    return { ...row, values, range: extent(values) };
  }); // prettier-ignore
  return { window, rows };
}

/** Value of a row at an instant, or null outside it. */
export function valueAt(result, { window, rows }, index, timeS) {
  const k = Math.round((timeS - result.startS) * result.rate) - window.first;
  const values = rows[index].values;
  return k >= 0 && k < values.length ? values[k] : null;
}
