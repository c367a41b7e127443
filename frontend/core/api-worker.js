/**
 * The worker of the live calls. A reply takes several turns of an event loop to arrive and to be decoded. In a worker
 * these turns do not queue behind the page's frames.
 *
 * Takes {id, call, body}; answers {id, answer} or {id, refused: {status, title, message, fields}}.
 */
import { postJson, simulate } from "./api.js";
import { LIVE_ARRAYS, makeResult } from "./result.js";

const CALLS = {
  posture: async (body) => ({ answer: await postJson("posture", body), transfer: [] }),
  postures: async (body) => ({ answer: await postJson("postures", body), transfer: [] }),
  voice: async (body) => {
    const answer = makeResult(await simulate(body, LIVE_ARRAYS));
    return { answer, transfer: [answer.waves.flow.buffer] }; // all arrays share one buffer: transferred, not copied
  },
};

self.onmessage = async ({ data: { id, call, body } }) => {
  try {
    const { answer, transfer } = await CALLS[call](body);
    self.postMessage({ id, answer }, transfer);
  } catch ({ status, title, message, fields }) {
    self.postMessage({ id, refused: { status, title, message, fields } });
  }
};
