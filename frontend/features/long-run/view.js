/** A longer run in the background: its progress, its result, its files. */
import { html } from "../../core/ui.js";
import { isActive, link } from "../../core/api.js";
import { cancelRun, duration, job, jobProblem, setDuration, showRun, startRun } from "./run.js";
import { RUN } from "./texts.js";

export function LongRun() {
  const shown = job.value;
  return html`
    <div class="long-run">
      <p>${RUN.about}</p>
      <div class="run-row">
        <label for="run-duration">${RUN.duration}</label>
        <input
          id="run-duration"
          type="range"
          min="0.5"
          max="10"
          step="0.5"
          value=${duration.value}
          onInput=${(event) => setDuration(event.target.valueAsNumber)}
        />
        <output>${duration.value.toFixed(1)}${" "}s</output>
        ${
          isActive(shown)
            ? html`
                <button type="button" class="button" onClick=${cancelRun}>${RUN.cancel}</button>
              `
            : html`
                <button type="button" class="button" onClick=${startRun}>${RUN.start}</button>
              `
        }
      </div>
      <p class="refusal" role="alert">${jobProblem.value}</p>
      ${
        shown &&
        html`
          <${JobState} shown=${shown} />
        `
      }
    </div>
  `;
}

function JobState({ shown }) {
  const file = (ending) => link(`jobs/${shown.id}/${ending}`);
  return html`
    <div class="job" data-status=${shown.status}>
      <p role="status">${RUN.statuses[shown.status]}${isActive(shown) && ` · ${Math.round(100 * shown.progress)} %`}</p>
      <progress max="1" value=${shown.progress} aria-label=${RUN.title}></progress>
      ${
        shown.problem &&
        html`
          <p class="refusal">${RUN.failed}${" "}${shown.problem.detail}</p>
        `
      }
      ${
        shown.status === "successful" &&
        html`
          <p class="run-actions">
            <button type="button" class="button" onClick=${showRun}>${RUN.show}</button>
            <span>${RUN.files}</span>
            <a href=${file("audio.wav")} download>${RUN.wav}</a>
            <a href=${file("result.nc")} download>${RUN.netcdf}</a>
            <a href=${file("result.csv")} download>${RUN.csv}</a>
          </p>
          <audio controls preload="none" src=${file("audio.wav")} aria-label=${RUN.wav}></audio>
        `
      }
    </div>
  `;
}
