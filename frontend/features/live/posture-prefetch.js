/**
 * Fetches the postures of neighbouring values of the control in use, nearest first. The next movement then finds its
 * shape here and shows it in the same frame.
 */
import { callWorker } from "../../core/api-worker-client.js";
import { postureRequest } from "../../core/parameters.js";
import { movedTogether, schema, values } from "../../state/request.js";

const ROWS = 12; // one for each control and everything else as it was
const AT_ONCE = 12; // in one call, which then takes about a frame
const REACH = 40; // steps to either side of the hand

const rows = new Map(); // name of a row → Map of value → answer, null where the model has none; oldest row first
let path = null; // of the control at hand
let asking = false;

/** The answer to the present request, when its place in the row at hand was reached before. */
export const cachedPosture = () => (path === null ? undefined : row().get(values.peek()[path]));

/** The hand has come to the control of this path. */
export function prefetchAround(newPath) {
  path = newPath;
  fetchMissing();
}

/** Fetch what is missing around the hand, call by call; the hand may move meanwhile. */
export async function fetchMissing() {
  if (asking || path === null) return;
  asking = true;
  try {
    for (let next = missing(); next.length; next = missing()) {
      const found = row();
      const { answers } = await callWorker("postures", {
        base: requestWithoutControl(),
        parameter: movedTogether(path),
        values: next,
      });
      next.forEach((value, k) => found.set(value, answers[k]));
    }
  } catch {
    // What could not be had ahead is asked for when the hand gets there, and that call says what is wrong.
  }
  asking = false;
}

/** The present request without what the control at hand sets. */
const requestWithoutControl = () => {
  const others = { ...values.peek() };
  for (const moved of movedTogether(path)) others[moved] = schema.peek().parameters.get(moved).default;
  return postureRequest(schema.peek(), others);
};

/** Answers by value of the control at hand, everything else as it is now. */
function row() {
  const name = JSON.stringify([movedTogether(path), requestWithoutControl()]);
  if (!rows.has(name)) {
    rows.set(name, new Map());
    if (rows.size > ROWS) rows.delete(rows.keys().next().value);
  }
  return rows.get(name);
}

/** The values around the hand that were not reached yet, the nearest first, as many as one call takes. */
function missing() {
  const { step, min, max, decimals } = schema.peek().parameters.get(path);
  const now = values.peek()[path];
  const next = [];
  if (!step || !Number.isFinite(now)) return next;
  const known = row();
  for (let k = 0; k <= 2 * REACH && next.length < AT_ONCE; k++) {
    const steps = k % 2 ? (k + 1) / 2 : -k / 2;
    const value = Number((now + steps * step).toFixed(decimals));
    if (value >= min && value <= max && !known.has(value)) next.push(value);
  }
  return next;
}
