/** Axes: round ticks, limits that do not jitter, numbers as people write them. Pure. */

const STEPS = [1, 2, 2.5, 5, 10];

/** The smallest round step that cuts `span` into at most `most` parts. */
export function niceStep(span, most) {
  const raw = span / most;
  const power = 10 ** Math.floor(Math.log10(raw));
  return power * STEPS.find((step) => step * power >= raw * (1 - 1e-9));
}

/** Round numbers in [low, high]. */
export function ticks(low, high, most = 4) {
  if (!(high > low)) return [low];
  const step = niceStep(high - low, most);
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, k) => (first + k) * step);
}

/** Ticks for a low plot: three or four, the fewest that show the scale. */
export function fewTicks(low, high) {
  const coarse = ticks(low, high, 3);
  return coarse.length >= 3 ? coarse : ticks(low, high, 4);
}

/** The smallest round number at or above `value`. */
export function niceCeil(value) {
  if (!(value > 0)) return 0;
  const power = 10 ** Math.floor(Math.log10(value));
  const fine = [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10];
  return power * fine.find((step) => step * power >= value * (1 - 1e-9));
}

/**
 * Limits around `data` = {min, max}: zero included, round, kept from `before` while the data still fill at least half
 * of them, so an axis does not move during a drag. `symmetric` centres them on zero.
 */
export function steadyLimits(before, data, { symmetric = false, least = 0 } = {}) {
  let low = Math.max(0, -data.min);
  let high = Math.max(0, data.max, least);
  if (symmetric) low = high = Math.max(low, high, least);
  const keep = (old, wanted) => Number.isFinite(old) && wanted <= old && wanted >= 0.5 * old;
  const bottom = keep(before && -before[0], low) ? -before[0] : niceCeil(low);
  const top = keep(before?.[1], high) ? before[1] : niceCeil(high);
  return [bottom === 0 ? 0 : -bottom, top || 1];
}

/** A tick's number: no more decimals than its step needs, a true minus, thin spaces in thousands. */
export function tickText(value, step = Math.abs(value) || 1) {
  const decimals = Math.max(0, Math.min(6, -Math.floor(Math.log10(step) + 1e-9)));
  const needed = Number.isInteger(step * 10 ** decimals) ? decimals : decimals + 1;
  return numberText(Math.abs(value) < step * 1e-6 ? 0 : value, needed);
}

/** 1234.5 → "1 234.5" with a narrow space and a true minus. */
export function numberText(value, decimals = 0) {
  const [whole, rest] = Math.abs(value).toFixed(decimals).split(".");
  const grouped = whole.length > 3 ? whole.replace(/\B(?=(\d{3})+$)/g, "\u202f") : whole;
  const negative = value < 0 && Number(value.toFixed(decimals)) !== 0;
  return (negative ? "\u2212" : "") + grouped + (rest ? `.${rest}` : "");
}
