/** State of the map over two parameters: what is requested, what has arrived, and the map held as A. */
import { batch, readonly, signal } from "../../core/ui.js";

/** The measures of every map, in the order of the menu. */
export const MEASURES = [
  "fo_hz",
  "spl_30cm_db",
  "mean_flow_ml_s",
  "speed_quotient",
  "closed_quotient",
  "contact_pressure_max_pa",
  "cpp_db",
  "gap_mm",
];
/** Above 50 × 50 points the server's events come without numbers. */
export const MOST_STEPS = 50;
const STEPS = 21;

const _axes = signal([
  { paths: ["activation.ct"], from: 0, to: 1, steps: STEPS },
  { paths: ["activation.ta"], from: 0, to: 1, steps: STEPS },
]);
const _measure = signal(MEASURES[0]);
const _map = signal(null);
const _heldMap = signal(null);
const _difference = signal(false);
const _following = signal(false);
const _running = signal(null);
const _problem = signal("");

/** Two of {paths, from, to, steps}: up, to the right. Several paths move together. */
export const axes = readonly(_axes);
/** Key of the chosen measure. */
export const measure = readonly(_measure);
/** {job, table, base}: the newest map and the patch it was made with; null before the first. */
export const map = readonly(_map);
/** The map held as A, or null. */
export const heldMap = readonly(_heldMap);
/** Whether the map minus A is wanted. */
export const difference = readonly(_difference);
/** Whether the map follows the settings that are not its axes. */
export const following = readonly(_following);
/** {done, total} of the present run, or null. */
export const running = readonly(_running);
export const mapProblem = readonly(_problem);

export function setAxis(place, changes) {
  _axes.value = _axes.value.map((axis, k) => (k === place ? { ...axis, ...changes } : axis));
}

export function setMeasure(key) {
  _measure.value = key;
}

export function holdMap() {
  _heldMap.value = _map.value;
}

export function setDifference(on) {
  _difference.value = on;
}

export function setFollowing(on) {
  _following.value = on;
}

export function takeRunning(progress) {
  _running.value = progress;
}

/** The previous map stays until the new one has a point. */
export function takeMap(news, base) {
  batch(() => {
    _running.value = { done: news.table.done, total: news.table.total };
    if (news.table.done) _map.value = { ...news, base };
    if (news.job.status === "failed") _problem.value = news.job.problem.detail;
  });
}

export function takeMapProblem(text) {
  _problem.value = text;
}
