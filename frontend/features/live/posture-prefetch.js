/**
 * Fetches the postures of neighbouring values of the control in use, nearest first. The next movement then finds its
 * shape here and shows it in the same frame.
 */
import { callWorker } from "../../core/api-worker-client.js";
import { patchText, postureRequest } from "../../core/parameters.js";
import { awaitsDefaults, movedTogether, patch, schema, values } from "../../state/request.js";

const ROWS = 12; // each for one control, with fixed values of all others
const AT_ONCE = 12; // per call, which then takes about one frame
const REACH = 40; // steps on either side of the present value

const rows = new Map(); // name of a row → Map of value → answer, null where the model has none; oldest row first
let path = null; // of the control in use
let asking = false;

/** The answer to the present request, if it is in the cache. A row holds requests with equal values of tied muscles. */
export function cachedPosture() {
  if (path === null) return undefined;
  const moved = movedTogether(path);
  const value = values.peek()[path];
  const isKnown = !awaitsDefaults.peek() || moved.every((one) => one in patch.peek());
  return isKnown && moved.every((one) => values.peek()[one] === value) ? row().get(value) : undefined;
}

/** The user has reached the control of this path. */
export function prefetchAround(newPath) {
  path = newPath;
  fetchMissing();
}

/** Fetch the missing neighbours of the present value, call by call; the value may change meanwhile. */
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
    // A posture that could not be prefetched is requested when its value is set; that call reports the problem.
  }
  asking = false;
}

/** The present request without the values of the control in use. */
const requestWithoutControl = () => {
  const others = { ...patch.peek() };
  for (const moved of movedTogether(path)) delete others[moved];
  return postureRequest(others);
};

/** Answers by value of the control in use, for the present values of all others. */
function row() {
  const name = JSON.stringify([movedTogether(path), patchText(patch.peek(), movedTogether(path))]);
  if (!rows.has(name)) {
    rows.set(name, new Map());
    if (rows.size > ROWS) rows.delete(rows.keys().next().value);
  }
  return rows.get(name);
}

/** Neighbouring values without an answer yet, nearest first, as many as one call takes. */
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
