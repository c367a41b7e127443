/**
 * Submits a sweep over parameters, follows it by the server's events, and keeps its table; values of a map from that
 * table.
 */
import { call, getJson, isActive, link, postJson, Problem } from "../../core/api.js";
import { typed } from "../../core/parameters.js";
import { API } from "../../core/texts.js";

/**
 * Run a sweep. Calls `report({job, table})` after every event; resolves when the job has ended, or was dismissed
 * because `signal` was aborted. `axes`: [{paths, values}] of at most 2500 points, so that events carry the numbers.
 */
export async function runSweep({ base, axes, measures }, report, signal) {
  let job = await postJson("jobs", sweepRequest(base, axes, measures));
  let table = emptyTable(axes, measures);
  const publish = (news) => {
    ({ job = job, table = table } = news);
    if (!signal.aborted) report({ job, table });
  };
  const readAll = async () =>
    publish({ table: withResult(table, await getJson(`jobs/${job.id}/result?partial=true`)) });
  publish({});
  if (isActive(job) && !signal.aborted) {
    await followed(job, signal, {
      // Points computed before the stream was open, now or after a break, have no event.
      opened: readAll,
      progress: (document) => publish({ job: document }),
      point: (points) => publish({ table: withPoints(table, points) }),
    });
  }
  if (signal.aborted) return dismiss(job);
  if (job.status === "successful" || table.done) await readAll();
}

/** Resolves when the job has ended or `signal` was aborted; rejects when there can be no stream. */
function followed({ links }, signal, on) {
  const events = new EventSource(new URL(links.events, link("")));
  return new Promise((resolve, reject) => {
    signal.addEventListener("abort", resolve);
    events.onopen = () => on.opened().catch(reject);
    events.onerror = () =>
      events.readyState === EventSource.CLOSED && reject(new Problem(0, API.noAnswer, API.noEvents));
    events.addEventListener("progress", ({ data }) => on.progress(JSON.parse(data)));
    events.addEventListener("point", ({ data }) => on.point(JSON.parse(data)));
    events.addEventListener("done", ({ data }) => {
      on.progress(JSON.parse(data));
      resolve();
    });
  }).finally(() => events.close());
}

/** A job that has ended meanwhile need not be stopped. */
async function dismiss({ id }) {
  try {
    await call(`jobs/${id}`, { method: "DELETE" });
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
  }
}

/** {paths, values} from the user's input {paths, from, to, steps}. Whole numbers stay whole. */
export function axisOf({ paths, from, to, steps }, row) {
  const [low, high] = [Number(typed(String(from))), Number(typed(String(to)))];
  const count = Number(steps);
  const values = Array.from({ length: count }, (_, k) =>
    Number((low + ((high - low) * k) / (count - 1)).toPrecision(12)),
  );
  return { paths, values: row.type === "integer" ? [...new Set(values.map(Math.round))] : values };
}

/** The body of POST /jobs: `base` is a simulation request. */
export function sweepRequest(base, axes, measures) {
  return { kind: "sweep", base, axes: axes.map(({ paths, values }) => ({ parameter: paths, values })), measures };
}

/**
 * A table without points. `states` and `measures` run over all points, last axis fastest. State null: not computed,
 * "failed": no answer; a measure null: no value. `reasons`: {key: [{reason, points}]}, `problems`: [{index, detail}].
 */
export function emptyTable(axes, measures) {
  const total = axes.reduce((n, { values }) => n * values.length, 1);
  const blank = () => new Array(total).fill(null);
  return {
    axes,
    total,
    done: 0,
    states: blank(),
    measures: Object.fromEntries(measures.map((key) => [key, blank()])),
    reasons: {},
    problems: [],
  };
}

/** The table with the points of one `point` event. */
export function withPoints(table, { index, phonation_state: states, measures, problems }) {
  const next = {
    ...table,
    states: [...table.states],
    measures: { ...table.measures },
    problems: [...table.problems, ...problems],
  };
  index.forEach((place, k) => (next.states[place] = states[k] ?? "failed"));
  for (const key of Object.keys(table.measures)) {
    next.measures[key] = [...table.measures[key]];
    index.forEach((place, k) => (next.measures[key][place] = measures[key][k]));
  }
  return counted(next);
}

/** The table with a whole or partial result; known points that are pending in it are unchanged. */
export function withResult(table, { phonation_state: states, measures, problems, pending }) {
  const waiting = new Set(pending);
  const merged = (before, now) => before.map((old, k) => (waiting.has(k) ? old : now[k]));
  return counted({
    ...table,
    states: merged(
      table.states,
      states.map((state) => state ?? "failed"),
    ),
    measures: Object.fromEntries(
      Object.keys(table.measures).map((key) => [key, merged(table.measures[key], measures[key].values)]),
    ),
    reasons: Object.fromEntries(Object.keys(table.measures).map((key) => [key, measures[key].reasons])),
    problems,
  });
}

const counted = (table) => ({ ...table, done: table.states.filter((state) => state !== null).length });

/** Whether two tables hold the same points, so that they can be subtracted. */
export const samePoints = (a, b) => JSON.stringify(a.axes) === JSON.stringify(b.axes);

/**
 * The cells of a map of measure `key`: {values, states}. Only a periodic voice has one pitch. A computed periodic cell
 * without a value is "unvalued"; null: not computed yet.
 */
export function mapOf(table, key) {
  const values = table.measures[key].map((value, k) =>
    key === "fo_hz" && table.states[k] !== "periodic" ? null : value,
  );
  return {
    values,
    states: table.states.map((state, k) => (state === "periodic" && values[k] === null ? "unvalued" : state)),
  };
}

/** Measure `key` of `b` minus that of `a`. A cell without a value has the state of the map that lacks it. */
export function differenceOf(a, b, key) {
  const [before, after] = [mapOf(a, key), mapOf(b, key)];
  const lacks = (k) => after.values[k] === null || before.values[k] === null;
  return {
    values: after.values.map((value, k) => (lacks(k) ? null : value - before.values[k])),
    states: after.states.map((state, k) =>
      state !== null && after.values[k] !== null && before.values[k] === null ? before.states[k] : state,
    ),
  };
}
