/** Hands in a sweep and tells its points as the server's events bring them; stops it when the signal says so. */
import { Problem, call, getJson, link, postJson } from "./api.js";
import { emptyTable, sweepRequest, withPoints, withResult } from "./sweep-table.js";
import { isActive } from "./state/job.js";
import { API } from "./texts.js";

/**
 * `tell({job, table})` whenever something came; resolves when the job has ended, or has been dismissed because
 * `signal` was aborted. `axes`: [{paths, values}] of at most 2500 points, so that events bring the numbers.
 */
export async function runSweep({ base, axes, measures }, tell, signal) {
  let job = await postJson("jobs", sweepRequest(base, axes, measures));
  let table = emptyTable(axes, measures);
  const said = (news) => {
    ({ job = job, table = table } = news);
    if (!signal.aborted) tell({ job, table });
  };
  const readAll = async () => said({ table: withResult(table, await getJson(`jobs/${job.id}/result?partial=true`)) });
  said({});
  if (isActive(job) && !signal.aborted) {
    await followed(job, signal, {
      // What was computed before the stream stood, now or after a break, is told by nobody.
      stands: readAll,
      progress: (document) => said({ job: document }),
      point: (points) => said({ table: withPoints(table, points) }),
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
    events.onopen = () => on.stands().catch(reject);
    events.onerror = () => events.readyState === EventSource.CLOSED && reject(new Problem(0, API.noAnswer, API.noEvents));
    events.addEventListener("progress", ({ data }) => on.progress(JSON.parse(data)));
    events.addEventListener("point", ({ data }) => on.point(JSON.parse(data)));
    events.addEventListener("done", ({ data }) => {
      on.progress(JSON.parse(data));
      resolve();
    });
  }).finally(() => events.close());
}

/** A job that has ended meanwhile needs no stopping. */
async function dismiss({ id }) {
  try {
    await call(`jobs/${id}`, { method: "DELETE" });
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
  }
}
