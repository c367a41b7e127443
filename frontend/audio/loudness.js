/** How loud a voice seems: its A-weighted level, so that two voices can be heard at the same loudness. Pure. */
import { powerSpectrum } from "../signal/fft.js";

const SIZE = 8192;

/** A-weighting as a gain, 1 at 1 kHz (IEC 61672-1). */
export function aWeight(hz) {
  const f2 = hz * hz;
  const raw = (w2) => (12194 ** 2 * w2 * w2) / ((w2 + 20.6 ** 2) * Math.sqrt((w2 + 107.7 ** 2) * (w2 + 737.9 ** 2)) * (w2 + 12194 ** 2));
  return raw(f2) / raw(1e6);
}

/** A-weighted rms of a loop, in its own unit. */
export function loudnessOf(loop, rate) {
  const count = Math.min(loop.length, SIZE);
  const power = powerSpectrum(loop, 0, count, SIZE);
  let sum = 0;
  // The window's own bandwidth is the same for both voices and falls out of their ratio.
  for (let k = 1; k < power.length; k++) sum += power[k] * aWeight((k * rate) / SIZE) ** 2;
  return Math.sqrt(sum);
}

/** Gains for two loops so that both sound as loud as the softer one; null loops stay silent. */
export function equalGains(loops, rate) {
  const levels = loops.map((loop) => (loop ? loudnessOf(loop, rate) : 0));
  const softest = Math.min(...levels.filter((level) => level > 0));
  return levels.map((level) => (level > 0 ? softest / level : 0));
}
