/** Calls the server through api-worker.js: the same promises as api.js, and the same problems. */
import { Problem } from "./api.js";

const worker = new Worker(new URL("api-worker.js", import.meta.url), { type: "module" });
const waiting = new Map(); // id → {resolve, reject}
let calls = 0;

/** `name`: posture, postures or voice. Rejects with a Problem. */
export function callWorker(name, body) {
  calls += 1;
  const id = calls;
  return new Promise((resolve, reject) => {
    waiting.set(id, { resolve, reject });
    worker.postMessage({ id, call: name, body });
  });
}

worker.onmessage = ({ data: { id, answer, refused } }) => {
  const { resolve, reject } = waiting.get(id);
  waiting.delete(id);
  if (refused) reject(new Problem(refused.status, refused.title, refused.message, refused.fields));
  else resolve(answer);
};
