/** A longer run in the background: submitted, followed by the server's events, shown or cancelled. */
import { readonly, signal } from "../../core/ui.js";
import { call, getArray, getJson, isActive, link, postJson } from "../../core/api.js";
import { simulationRequest } from "../../core/parameters.js";
import { LIVE_ARRAYS, makeResult } from "../../core/result.js";
import { takeResult } from "../../state/answers.js";
import { patch } from "../../state/request.js";
import { showNotice } from "../../state/session.js";
import { RUN } from "./texts.js";

const _duration = signal(5);
const _job = signal(null);
const _problem = signal("");

/** Seconds to simulate. */
export const duration = readonly(_duration);
/** The job as the server describes it, or null. */
export const job = readonly(_job);
/** Why it could not be submitted or followed. */
export const jobProblem = readonly(_problem);

export function setDuration(seconds) {
  _duration.value = seconds;
}

export function takeJob(answer) {
  _job.value = answer;
  _problem.value = "";
}

export function takeJobProblem(text) {
  _problem.value = text;
}

const SHOWN_S = 0.5;
const WAVES = LIVE_ARRAYS.filter((name) => /^(radiated|glottal|contact)/.test(name));

let events = null;

export async function startRun() {
  stopFollowing();
  const body = simulationRequest(patch.peek(), { duration_s: duration.peek() });
  await guarded(async () => {
    takeJob(await postJson("jobs", body));
    if (isActive(job.peek())) follow(job.peek());
  });
}

export async function cancelRun() {
  await guarded(async () => takeJob(await (await call(`jobs/${job.peek().id}`, { method: "DELETE" })).json()));
  stopFollowing();
}

/** Put the end of the finished run on the page, as if it had been computed live. */
export async function showRun() {
  const { id } = job.peek();
  await guarded(async () => {
    const header = await getJson(`jobs/${id}/result`);
    const rate = header.provenance.sample_rate_hz;
    const samples = header.arrays.glottal_flow_m3_s.shape[0];
    const start = Math.max(0, samples - Math.round(SHOWN_S * rate));
    const parts = await Promise.all(
      LIVE_ARRAYS.map(async (name) => [name, await getArray(id, name, WAVES.includes(name) ? { start } : {})]),
    );
    takeResult(makeResult({ header: { ...header, id }, arrays: Object.fromEntries(parts) }, start / rate));
    showNotice(RUN.shown(samples / rate));
  });
}

export function stopFollowing() {
  events?.close();
  events = null;
}

function follow({ links }) {
  events = new EventSource(new URL(links.events, link("")));
  const take = (event) => {
    takeJob(JSON.parse(event.data));
    if (!isActive(job.peek())) stopFollowing();
  };
  events.addEventListener("progress", take);
  events.addEventListener("done", take);
}

async function guarded(work) {
  try {
    await work();
  } catch (error) {
    takeJobProblem(error.message);
  }
}
