/** All lessons, to choose one. */
import { html, useEffect } from "../ui.js";
import { loadLessons, startLesson } from "../lessons.js";
import { lesson, lessonProblem, lessons } from "../state/lessons.js";
import { LESSONS } from "../texts.js";

export function LessonList() {
  useEffect(() => void loadLessons(), []);
  return html`
    <div class="lessons">
      <p>${LESSONS.about}</p>
      ${lessonProblem.value ? html`<p class="refusal" role="alert">${LESSONS.failed}</p>` : !lessons.value && html`<p role="status">${LESSONS.loading}</p>`}
      <ol>
        ${lessons.value?.map(({ key, title, about, steps }) => html`
          <li key=${key}>
            <button type="button" class="lesson-row" aria-current=${lesson.value?.key === key ? "true" : undefined} onClick=${() => startLesson(key)}>
              <b>${title}</b> <span class="when">${LESSONS.minutes(steps)}</span><span class="about">${about}</span>
            </button>
          </li>
        `)}
      </ol>
    </div>
  `;
}
