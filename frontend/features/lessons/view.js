/** The list of lessons, and the card of the present step. */
import { html, useEffect, useRef } from "../../core/ui.js";
import { MathsSymbol } from "../../core/maths-symbol.js";
import { result } from "../../state/answers.js";
import { catalogue } from "../../state/request.js";
import {
  endLesson,
  goToStep,
  lesson,
  lessonProblem,
  lessons,
  loadLessons,
  measuresOf,
  present,
  startLesson,
  step,
} from "./lessons.js";
import { LESSONS } from "./texts.js";
import { valueText } from "../measures/value-text.js";

export function LessonCard() {
  const title = useRef(null);
  const { key, title: name, steps } = lesson.value;
  const place = step.value;
  useEffect(() => title.current.focus({ preventScroll: true }), [key]);
  useEffect(() => scrollTo(0, 0), [key, place]); // on a phone the list of lessons is further down
  const { say, see } = present.value;
  const last = place === steps.length - 1;
  return html`
    <section class="lesson-card card" aria-labelledby="lesson-title" data-lesson=${key} data-step=${place}>
      <div class="card-head">
        <h2 id="lesson-title" tabindex="-1" ref=${title}>${name}</h2>
        <span class="when">${LESSONS.step(place + 1, steps.length)}</span>
      </div>
      <div class="lesson-words" aria-live="polite">
        <p>${say}</p>
        <p>
          <b>${LESSONS.see}.</b>
          ${" "}${see}
        </p>
      </div>
      <div class="lesson-actions">
        <button type="button" class="button" disabled=${place === 0} onClick=${() => goToStep(place - 1)}>
          ${LESSONS.back}
        </button>
        <button type="button" class="button primary" onClick=${() => (last ? endLesson() : goToStep(place + 1))}>
          ${last ? LESSONS.done : LESSONS.next}
        </button>
        <button type="button" class="quiet" onClick=${endLesson}>${LESSONS.all}</button>
        <${Numbers} />
      </div>
    </section>
  `;
}

/** The present values of the measures that the step names; the panel of the step may not show them. */
function Numbers() {
  const measures = result.value?.measures ?? {};
  return html`
    <dl class="lesson-numbers" aria-label=${LESSONS.numbers}>
      ${measuresOf(present.value).map((key) => {
        const row = catalogue.value.get(key);
        return html`
          <div key=${key} data-measure=${key} title=${row.name}>
            <dt><${MathsSymbol} text=${row.symbol} /></dt>
            <dd>${valueText(measures[key], row)}</dd>
          </div>
        `;
      })}
    </dl>
  `;
}

export function LessonList() {
  useEffect(() => void loadLessons(), []);
  return html`
    <div class="lessons">
      <p>${LESSONS.about}</p>
      ${
        lessonProblem.value
          ? html`
              <p class="refusal" role="alert">${LESSONS.failed}</p>
            `
          : !lessons.value &&
            html`
              <p role="status">${LESSONS.loading}</p>
            `
      }
      <ol>
        ${lessons.value?.map(
          ({ key, title, about, steps }) => html`
            <li key=${key}>
              <button
                type="button"
                class="lesson-row"
                aria-current=${lesson.value?.key === key ? "true" : undefined}
                onClick=${() => startLesson(key)}
              >
                <b>${title}</b>
                ${" "}
                <span class="when">${LESSONS.minutes(steps)}</span>
                <span class="about">${about}</span>
              </button>
            </li>
          `,
        )}
      </ol>
    </div>
  `;
}
