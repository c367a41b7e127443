/** Computes the map over two parameters, stops it, and lets it follow the other settings. */
import { effect, untracked } from "../../core/ui.js";
import { Problem } from "../../core/api.js";
import { patchText, simulationRequest } from "../../core/parameters.js";
import { patch, restorePatch, schema } from "../../state/request.js";
import { LIVE_S } from "../live/follow-request.js";
import { axes, following, map, MEASURES, MOST_STEPS, takeMap, takeMapProblem, takeRunning } from "./state.js";
import { axisOf, runSweep } from "./sweep.js";
import { MAP } from "./texts.js";

const REST_MS = 500; // without a movement before the map is computed again

let run = null; // {control, ended}
let madeWith = "";

/** Compute the map of the present settings. A running one is stopped first: it may be the same job. */
export function startMap() {
  const before = run;
  before?.control.abort();
  const control = new AbortController();
  const mine = (run = { control, ended: Promise.resolve() });
  mine.ended = make(before?.ended, mine);
  return mine.ended;
}

export function cancelMap() {
  run?.control.abort();
}

async function make(before, mine) {
  const { signal } = mine.control;
  const wanted = axes.peek();
  const base = patch.peek();
  const refusal = refusalOf(wanted);
  madeWith = others(wanted, base);
  takeMapProblem(refusal);
  try {
    await before;
    if (refusal || signal.aborted) return;
    takeRunning({ done: 0, total: wanted[0].steps * wanted[1].steps });
    const asked = wanted.map((axis) => axisOf(axis, schema.peek().parameters.get(axis.paths[0])));
    const request = simulationRequest(base, { duration_s: LIVE_S });
    await runSweep({ base: request, axes: asked, measures: MEASURES }, (news) => takeMap(news, base), signal);
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    takeMapProblem(error.fields.length ? error.fields.map(MAP.refused).join(" ") : error.message);
  } finally {
    if (run === mine) {
      run = null;
      takeRunning(null);
    }
  }
}

/**
 * What the page itself can find wrong; the server judges the values.
 *
 * @param {{paths: string[], steps: number}[]} axes
 */
function refusalOf([up, right]) {
  if (up.paths.some((path) => right.paths.includes(path))) return MAP.sameTwice;
  const uncounted = [up, right].some(
    ({ steps }) => !Number.isInteger(Number(steps)) || steps < 2 || steps > MOST_STEPS,
  );
  return uncounted ? MAP.steps(MOST_STEPS) : "";
}

/** What all cells of a map over `wanted` share. */
const others = (wanted, base) =>
  patchText(
    base,
    wanted.flatMap(({ paths }) => paths),
  );

/** Set the voice of a cell: the patch of the map with the cell's values on its axes. */
export function loadCell({ table, base }, point) {
  const moved = table.axes.flatMap(({ paths }, k) => paths.map((path) => [path, point[k]]));
  restorePatch(base, Object.fromEntries(moved));
}

/** Computes the map again once settings other than its axes have changed; returns a function that stops it. */
export function followSettings() {
  let waiting = 0;
  const stop = effect(() => {
    const now = following.value && map.value && others(axes.value, patch.value);
    clearTimeout(waiting);
    if (now && now !== madeWith) waiting = setTimeout(() => untracked(startMap), REST_MS);
  });
  return () => {
    stop();
    clearTimeout(waiting);
  };
}
