/** Levels over frequency, the harmonics, the gain of the tract, and levels over frequency and time. Pure. */
import { levelDb, powerOfTwo, powerSpectrum } from "../../core/fft.js";
import { measured } from "../../core/result.js";

export const TOP_HZ = 5000;
const STEADY_S = 0.25; // of the end of the run: a resolution of about 8 Hz with the window
const NARROW_S = 0.03; // of one column of the spectrogram: harmonics are resolved
const COLUMNS = 180;

/** {frequencyHz, levelDb, harmonics: [{hz, db}]} of the end of the radiated pressure. */
export function spectrumOf(result) {
  const { pressure } = result.waves;
  const count = Math.min(pressure.length, Math.round(STEADY_S * result.rate));
  const size = powerOfTwo(2 * count);
  const power = powerSpectrum(pressure, pressure.length - count, count, size);
  const step = result.rate / size;
  const bins = Math.min(power.length, Math.floor(TOP_HZ / step) + 1);
  const frequencyHz = Float64Array.from({ length: bins }, (_, k) => k * step);
  const levels = Float64Array.from({ length: bins }, (_, k) => levelDb(power[k]));
  return { frequencyHz, levelDb: levels, harmonics: harmonicsOf(measured(result, "fo_hz"), levels, step) };
}

function harmonicsOf(pitch, levels, step) {
  if (!pitch) return [];
  const found = [];
  for (let n = 1; n * pitch < TOP_HZ; n++) {
    const from = Math.max(0, Math.round(((n - 0.25) * pitch) / step));
    const to = Math.min(levels.length - 1, Math.round(((n + 0.25) * pitch) / step));
    let best = from;
    for (let k = from; k <= to; k++) if (levels[k] > levels[best]) best = k;
    found.push({ hz: best * step, db: levels[best] });
  }
  return found;
}

/** The gain of the tract in dB, shifted so that its highest peak is at `topDb`. */
export function gainCurve(tract, topDb) {
  const gains = tract.lip_pressure_per_flow_pa_s_m3;
  const highest = Math.max(...gains);
  return tract.frequency_hz
    .map((hz, k) => [hz, topDb + 20 * Math.log10(gains[k] / highest)])
    .filter(([hz]) => hz <= TOP_HZ);
}

/** {columns, rows, stepHz, levels, topDb}: levels (column by column, low frequency first) over the whole wave. */
export function spectrogramOf(result) {
  const { pressure } = result.waves;
  const count = Math.min(pressure.length, Math.round(NARROW_S * result.rate));
  const size = powerOfTwo(count);
  const stepHz = result.rate / size;
  const rows = Math.floor(TOP_HZ / stepHz) + 1;
  const columns = Math.max(1, Math.min(COLUMNS, pressure.length - count));
  const levels = new Float32Array(columns * rows);
  let topDb = -Infinity;
  for (let c = 0; c < columns; c++) {
    const first = Math.floor((c / Math.max(1, columns - 1)) * (pressure.length - count));
    const power = powerSpectrum(pressure, first, count, size);
    for (let k = 0; k < rows; k++) {
      const level = levelDb(power[k]);
      levels[c * rows + k] = level;
      if (level > topDb) topDb = level;
    }
  }
  return {
    columns,
    rows,
    stepHz,
    levels,
    topDb,
    firstS: result.startS + count / 2 / result.rate,
    lastS: result.durationS - count / 2 / result.rate,
  };
}
