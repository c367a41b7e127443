/** A figure of the paper as data: its points, the request of each, and what is kept of each answer. Pure. */
import { makeResult } from "./result.js";

/** Values of each axis at every point, the last axis fastest: [[ct, ta], …]; one empty point without axes. */
export function pointsOf({ axes }) {
  return axes.reduce((points, { values }) => points.flatMap((point) => values.map((v) => [...point, v])), [[]]);
}

/** The request document of a point of a figure. */
export function requestAt({ base, axes }, point) {
  const moved = {};
  axes.forEach(({ parameter }, k) => parameter.forEach((path) => (moved[path.replace("activation.", "")] = point[k])));
  return { ...base, activation: { ...base.activation, ...moved } };
}

/** Arrays of a shipped voice, numbers in JSON, as those of a reply. */
export function voiceOf({ result, arrays, start_s }) {
  const typed = Object.fromEntries(
    Object.entries(arrays).map(([name, { data, ...rest }]) => [name, { ...rest, data: ArrayBuffer.isView(data) ? data : Float32Array.from(data) }]),
  );
  return { ...makeResult({ header: { id: null, ...result }, arrays: typed }, start_s), staticShape: result.static_shape };
}

/**
 * What a map shows in each cell: "voice" or why there is none. A cell that repeats counts as voice when its flow pulses
 * and it is not far below the level of the others: the rule of the scoreboard, whose numbers come with the figure.
 */
export function mapStates({ states, measures, voicing }) {
  const { ac_flow_ml_s: ac, mean_flow_ml_s: mean, spl_lips_db: level } = measures;
  const lasting = states.map((state, k) => (state === "periodic" || state === "subharmonic") && level[k] !== null);
  const levels = level.filter((_, k) => lasting[k]).sort((a, b) => a - b);
  const quietest = medianOf(levels) - voicing.max_below_median_db;
  return states.map((state, k) => {
    if (!lasting[k]) return state === "periodic" || state === "subharmonic" ? "weak" : state;
    const voiced = ac[k] >= voicing.min_ac_over_mean * mean[k] && level[k] >= quietest;
    return voiced ? (state === "subharmonic" ? "subharmonic" : "voice") : "weak";
  });
}

function medianOf(sorted) {
  const half = sorted.length >> 1;
  return sorted.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}
