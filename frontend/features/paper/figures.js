/** The figures of the paper: loaded when first shown, and computed again on the server point by point. */
import { call, getJson, Problem, simulate } from "../../core/api.js";
import { LIVE_ARRAYS, makeResult } from "../../core/result.js";
import { paper, takeFresh, takePaper, takePaperProblem, takeRun } from "./state.js";
import { PAPER } from "./texts.js";

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

/** A shipped voice, whose arrays are numbers in JSON, in the form of a reply. */
export function voiceOf({ result, arrays, start_s }) {
  const typed = Object.fromEntries(
    Object.entries(arrays).map(([name, { data, ...rest }]) => [
      name,
      { ...rest, data: ArrayBuffer.isView(data) ? data : Float32Array.from(data) },
    ]),
  );
  return {
    ...makeResult({ header: { id: null, ...result }, arrays: typed }, start_s),
    staticShape: result.static_shape,
  };
}

/**
 * The state of each cell of a map: "voice", or why there is none. A periodic cell counts as voice if its flow pulses
 * and its level is not far below the others: the rule of the scoreboard, whose limits come with the figure.
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

const SIDE_BY_SIDE = 2; // the server's limit for one page
const BUSY_MS = 400;

let running = null;

export async function loadPaper() {
  if (paper.peek()) return;
  try {
    takePaper(await getJson(new URL("paper.json", import.meta.url).href));
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    takePaperProblem(PAPER.notLoaded(error.message));
  }
}

export function cancelFigure() {
  running?.abort();
}

/** Compute every point of `figure` again and replace the figure; one figure at a time. */
export async function remake(figure) {
  running?.abort();
  const control = (running = new AbortController());
  takePaperProblem("");
  takeRun({ key: figure.key, done: 0, total: pointsOf(figure).length });
  try {
    const report = (done, total) => !control.signal.aborted && takeRun({ key: figure.key, done, total });
    const answers = await answersOf(figure, report, control.signal);
    const { version, model_version } = await getJson("health");
    if (!control.signal.aborted)
      takeFresh(assembled(figure, answers), {
        created: new Date().toISOString(),
        model_version,
        code_version: version,
      });
  } catch (error) {
    if (error.name !== "AbortError" && !(error instanceof Problem)) throw error;
    if (error.name !== "AbortError") takePaperProblem(error.message);
  } finally {
    if (running === control) {
      running = null;
      takeRun(null);
    }
  }
}

/**
 * The answers at all points of `figure`, in order; calls `report(done, total)` after each. Only this function knows how
 * points reach the server.
 */
async function answersOf(figure, report, signal) {
  const points = pointsOf(figure);
  const answers = new Array(points.length);
  let next = 0;
  let done = 0;
  const work = async () => {
    while (next < points.length) {
      const k = next++;
      answers[k] = await patiently(() => ANSWER[figure.kind](requestAt(figure, points[k]), signal), signal);
      report(++done, points.length);
    }
  };
  await Promise.all(Array.from({ length: SIDE_BY_SIDE }, work));
  return answers;
}

const point = async (body, signal) => (await call("simulate", { method: "POST", body, signal })).json();

/** By kind of figure: the call for one point. */
const ANSWER = {
  static: async ({ run, ...body }, signal) =>
    (await (await call("posture", { method: "POST", body, signal })).json()).static_shape,
  voice: (body, signal) => simulate(body, LIVE_ARRAYS, signal),
  map: point,
  sweep: point,
};

/** Repeats the call while the server is busy. A failed run is an answer too. */
async function patiently(ask, signal) {
  for (;;) {
    signal.throwIfAborted();
    try {
      return await ask();
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      if (error.status === 422) return { phonation_state: "failed", measures: {} };
      if (error.status !== 503 && error.status !== 429) throw error;
      await new Promise((resolve) => setTimeout(resolve, BUSY_MS));
    }
  }
}

/** `figure` with new answers in the form of the shipped ones. */
function assembled(figure, answers) {
  if (figure.kind === "static") return { ...figure, shapes: answers };
  if (figure.kind === "voice") return { ...figure, result: answers[0].header, arrays: answers[0].arrays, start_s: 0 };
  const table = (key) => answers.map((one) => one.measures[key]?.value ?? null);
  const measures = Object.fromEntries(Object.keys(figure.measures).map((key) => [key, table(key)]));
  return { ...figure, states: answers.map((one) => one.phonation_state), measures };
}
