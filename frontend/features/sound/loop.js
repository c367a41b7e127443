/** From the pressure of one run to a buffer that repeats without a seam. Pure. */

const WANTED_S = 0.3;
const SEAM_PERIODIC_S = 0.004;
const SEAM_IRREGULAR_S = 0.03;
const HALF_TAPS = 16;

/** `wave` at the samples `from + k·step`, k < count: windowed sinc, band-limited for both rates. */
export function resample(wave, from, step, count) {
  const cutoff = Math.min(1, 1 / step);
  const half = HALF_TAPS / cutoff;
  const out = new Float32Array(count);
  for (let k = 0; k < count; k++) {
    const position = from + k * step;
    const first = Math.ceil(position - half);
    const last = Math.floor(position + half);
    let value = 0;
    for (let i = first; i <= last; i++) {
      const t = i - position;
      const x = Math.PI * t * cutoff;
      const sinc = Math.abs(x) < 1e-9 ? 1 : Math.sin(x) / x;
      const hann = 0.5 + 0.5 * Math.cos((Math.PI * t) / half);
      value += wave[Math.max(0, Math.min(wave.length - 1, i))] * sinc * hann;
    }
    out[k] = value * cutoff;
  }
  return out;
}

/**
 * A loop of whole periods (of any length where nothing repeats) from the end of `wave`, at `outRate`.
 *
 * The last few milliseconds fade into the samples before the first one, so the jump back is continuous.
 */
export function makeLoop(wave, rate, { periodS, periodic }, outRate) {
  const availableS = wave.length / rate;
  const seamS = periodic ? SEAM_PERIODIC_S : SEAM_IRREGULAR_S;
  const periods = Math.max(1, Math.round(Math.min(WANTED_S, 0.5 * availableS) / periodS));
  const lengthS = Math.min(periods * periodS, availableS - 2 * seamS);
  const count = Math.round(lengthS * outRate);
  const step = (lengthS * rate) / count;
  const from = wave.length - 1 - lengthS * rate - HALF_TAPS;
  const loop = resample(wave, from, step, count);
  const seam = Math.round(seamS * outRate);
  const before = resample(wave, from - seam * step, step, seam);
  for (let k = 0; k < seam; k++) {
    const share = 0.5 - 0.5 * Math.cos((Math.PI * (k + 0.5)) / seam);
    loop[count - seam + k] = (1 - share) * loop[count - seam + k] + share * before[k];
  }
  return withoutMean(loop);
}

/** A whole run at `outRate`, faded over 10 ms at both ends. */
export function makeOnce(wave, rate, outRate) {
  const count = Math.floor((wave.length * outRate) / rate);
  const run = withoutMean(resample(wave, 0, rate / outRate, count));
  const fade = Math.min(Math.round(0.01 * outRate), count >> 1);
  for (let k = 0; k < fade; k++) {
    const share = 0.5 - 0.5 * Math.cos((Math.PI * (k + 0.5)) / fade);
    run[k] *= share;
    run[count - 1 - k] *= share;
  }
  return run;
}

function withoutMean(wave) {
  const mean = wave.reduce((sum, v) => sum + v, 0) / wave.length;
  return wave.map((v) => v - mean);
}
