/** The longer run worked on in the background. */
import { signal } from "../ui.js";
import { readonly } from "./readonly.js";

const _duration = signal(5);
const _job = signal(null);
const _problem = signal("");

/** Seconds to simulate. */
export const duration = readonly(_duration);
/** The job as the server describes it, or null. */
export const job = readonly(_job);
/** Why it could not be handed in or followed. */
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

export const isActive = (answer) => answer !== null && ["accepted", "running"].includes(answer.status);
