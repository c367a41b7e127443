/** What the hand does goes to the server by itself: posture and voice, newest wins, and comes back on the page. */
import { effect } from "./ui.js";
import { Problem } from "./api.js";
import { afterPaint } from "./frame.js";
import { Lane } from "./lane.js";
import { recordInput, recordShown } from "./latency.js";
import { postureRequest, simulationRequest } from "./params.js";
import { ask } from "./stagehand.js";
import { takePosture, takeProblem, takeResult } from "./state/outcome.js";
import { status } from "./state/play.js";
import { gesture, schema, values, version } from "./state/request.js";
import { connection, setConnection } from "./state/session.js";

export const LIVE_S = 0.5;
const RETRY_MS = 1500;
const VOICE_REST_MS = 30; // between voices, so that shapes follow the hand more closely than the voice
const PLAYED_REST_MS = 250; // while a voice is played: it has the machine first, and shows what it does itself

/** Starts following the request; returns the end of it. */
export function followRequest() {
  let retry = 0;
  const failed = (call) => (error, job) => {
    if (!(error instanceof Problem)) throw error;
    if (error.status === 401) return setConnection("login");
    if (error.status === 0 || error.status === 503 || error.status === 429) {
      setConnection("offline");
      clearTimeout(retry);
      retry = setTimeout(() => push(job), RETRY_MS);
    }
    if (job.version === version.peek()) takeProblem(call, error, job.version);
  };
  const postures = new Lane(
    (job) => ask("posture", job.postureBody),
    (answer, job) => {
      setConnection("ready");
      takePosture(answer, job.gesture);
      afterPaint(() => recordShown("slider to shape", job.version));
    },
    failed("posture"),
  );
  const voices = new Lane(
    (job) => ask("voice", job.body),
    (answer, job) => {
      takeResult(answer, job.version);
      afterPaint(() => recordShown("slider to all", job.version));
    },
    failed("voice"),
    VOICE_REST_MS,
  );
  const push = (job) => {
    postures.push(job);
    voices.push(job);
  };
  const stop = effect(() => {
    if (!schema.value || connection.value === "login" || connection.value === "starting") return;
    const job = {
      version: version.value,
      gesture: gesture.value,
      body: simulationRequest(schema.value, values.value, { duration_s: LIVE_S }),
      postureBody: postureRequest(schema.value, values.value),
    };
    recordInput(job.version);
    push(job);
  });
  const yields = effect(() => void (voices.restMs = status.value === "off" ? VOICE_REST_MS : PLAYED_REST_MS));
  return () => {
    stop();
    yields();
    clearTimeout(retry);
  };
}
