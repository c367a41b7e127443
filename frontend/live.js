/** What the hand does goes to the server by itself: posture and voice, newest wins, and comes back on the page. */
import { effect, untracked } from "./ui.js";
import { fetchAhead, postureAhead } from "./ahead.js";
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
// Between postures and between runs beside a played voice: it has the machine first, and shows what it does.
const PLAYED_POSTURE_REST_MS = 80;
const PLAYED_RUN_REST_MS = 600;

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
  let shown = 0;
  const show = (answer, job) => {
    if (job.version < shown) return; // a newer one was at hand
    shown = job.version;
    takePosture(answer, job.gesture);
    afterPaint(() => recordShown("slider to shape", job.version));
  };
  const postures = new Lane(
    (job) => ask("posture", job.postureBody),
    (answer, job) => {
      setConnection("ready");
      show(answer, job);
    },
    failed("posture"),
  );
  const voices = new Lane(
    (job) => ask("voice", job.body),
    (answer, job) => {
      setConnection("ready"); // where the shape was at hand no other call says so
      takeResult(answer, job.version);
      afterPaint(() => recordShown("slider to all", job.version));
    },
    failed("voice"),
  );
  const push = (job) => {
    const ahead = postureAhead();
    if (ahead) show(ahead, job);
    else postures.push(job);
    voices.push(job);
    fetchAhead();
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
    untracked(() => push(job));
  });
  const yields = effect(() => {
    const played = status.value !== "off";
    postures.restMs = played ? PLAYED_POSTURE_REST_MS : 0;
    voices.restMs = played ? PLAYED_RUN_REST_MS : 0;
  });
  return () => {
    stop();
    yields();
    clearTimeout(retry);
  };
}
