/**
 * Sends every change of the request to the server, newest first, and takes the posture and the voice that come back.
 */
import { effect, untracked } from "../../core/ui.js";
import { callWorker } from "../../core/api-worker-client.js";
import { Problem } from "../../core/api.js";
import { afterPaint } from "../../core/frame.js";
import { recordInput, recordShown } from "../../core/latency.js";
import { LatestOnly } from "../../core/latest-only.js";
import { postureRequest, simulationRequest } from "../../core/parameters.js";
import { takePosture, takeProblem, takeResult } from "../../state/answers.js";
import { status } from "../../state/played-voice.js";
import { movement, patch, schema, version } from "../../state/request.js";
import { entered, setConnection } from "../../state/session.js";
import { cachedPosture, fetchMissing } from "./posture-prefetch.js";

export const LIVE_S = 0.5;
export const RETRY_MS = 1500;
// Pauses between postures and between runs during live play: the played voice comes first, and it shows its own shape.
const PLAYED_POSTURE_REST_MS = 80;
const PLAYED_RUN_REST_MS = 600;

/** Whether a call failed for now and is worth repeating: the server is away or has no room. */
export const isBusy = ({ status }) => status === 0 || status === 503 || status === 429;

/** Starts following the request; returns a function that stops it. */
export function followRequest() {
  let retry = 0;
  let newest = null;
  const failed = (call) => (error, job) => {
    if (!(error instanceof Problem)) throw error;
    if (error.status === 401) return setConnection("login");
    if (isBusy(error)) {
      setConnection("offline");
      clearTimeout(retry);
      retry = setTimeout(() => push(newest), RETRY_MS);
    }
    if (job.version === version.peek()) takeProblem(call, error, job.version);
  };
  let shown = 0;
  const show = (answer, job) => {
    if (job.version < shown) return; // a newer one came from the cache
    shown = job.version;
    takePosture(answer, job.movement);
    afterPaint(() => recordShown("slider to shape", job.version));
  };
  const postures = new LatestOnly(
    (job) => callWorker("posture", job.postureBody),
    (answer, job) => {
      setConnection("ready");
      show(answer, job);
    },
    failed("posture"),
  );
  const voices = new LatestOnly(
    (job) => callWorker("voice", job.body),
    (answer, job) => {
      setConnection("ready"); // with a cached shape, no posture call has set it
      takeResult(answer, job.version);
      afterPaint(() => recordShown("slider to all", job.version));
    },
    failed("voice"),
  );
  const push = (job) => {
    const cached = cachedPosture();
    if (cached) show(cached, job);
    else postures.push(job);
    voices.push(job);
    fetchMissing();
  };
  const stop = effect(() => {
    if (!schema.value || !entered.value) return;
    const job = {
      version: version.value,
      movement: movement.value,
      body: simulationRequest(patch.value, { duration_s: LIVE_S }),
      postureBody: postureRequest(patch.value),
    };
    newest = job;
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
