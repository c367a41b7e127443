/** Spectra of waves: a radix-2 Fourier transform and the windowed power spectrum. Pure. */

const REFERENCE_PA = 20e-6;

/** In-place transform of complex values; length a power of two. */
export function transform(re, im) {
  const n = re.length;
  for (let i = 1, j = 0; i < n; i++) {
    let bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) {
      [re[i], re[j]] = [re[j], re[i]];
      [im[i], im[j]] = [im[j], im[i]];
    }
  }
  for (let size = 2; size <= n; size <<= 1) {
    const half = size >> 1;
    const turn = (-2 * Math.PI) / size;
    for (let k = 0; k < half; k++) {
      const c = Math.cos(turn * k);
      const s = Math.sin(turn * k);
      for (let at = k; at < n; at += size) {
        const other = at + half;
        const r = re[other] * c - im[other] * s;
        const i = re[other] * s + im[other] * c;
        re[other] = re[at] - r;
        im[other] = im[at] - i;
        re[at] += r;
        im[at] += i;
      }
    }
  }
}

const windows = new Map();

/** Hann window of `count` samples with mean 1, so that a sine keeps its amplitude. */
function hann(count) {
  if (!windows.has(count))
    windows.set(
      count,
      Float64Array.from({ length: count }, (_, k) => 1 - Math.cos((2 * Math.PI * (k + 0.5)) / count)),
    );
  return windows.get(count);
}

/**
 * Power of `count` samples from `first`, zero-padded to `size`: mean square per bin, so that a sine that falls on a bin
 * shows its own mean square there. Float64Array (size/2).
 */
export function powerSpectrum(wave, first, count, size) {
  const re = new Float64Array(size);
  const im = new Float64Array(size);
  const window = hann(count);
  let mean = 0;
  for (let k = 0; k < count; k++) mean += wave[first + k] / count;
  for (let k = 0; k < count; k++) re[k] = (wave[first + k] - mean) * window[k];
  transform(re, im);
  const out = new Float64Array(size / 2);
  for (let k = 0; k < out.length; k++) out[k] = (2 * (re[k] ** 2 + im[k] ** 2)) / count ** 2;
  return out;
}

/** Mean square in Pa² as a level, dB re 20 µPa. */
export const levelDb = (power) => 10 * Math.log10(Math.max(power, 1e-14) / REFERENCE_PA ** 2);

export const powerOfTwo = (count) => 2 ** Math.ceil(Math.log2(count));
