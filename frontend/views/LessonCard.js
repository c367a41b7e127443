/** The step of a lesson: what was set, what to see, the numbers it speaks of, on to the next. It takes the place of the maps. */
import { html, useEffect, useRef } from "../ui.js";
import { endLesson, goToStep, lesson, measuresOf, present, step } from "../state/lessons.js";
import { result } from "../state/outcome.js";
import { catalogue } from "../state/request.js";
import { Symbol } from "../symbol.js";
import { LESSONS } from "../texts.js";
import { valueText } from "./measure-text.js";

export function LessonCard() {
  const title = useRef(null);
  const { key, title: name, steps } = lesson.value;
  const place = step.value;
  useEffect(() => title.current.focus({ preventScroll: true }), [key]);
  useEffect(() => scrollTo(0, 0), [key, place]); // on a phone the list of lessons lay further down
  const { say, see } = present.value;
  const last = place === steps.length - 1;
  return html`
    <section class="lesson-card card" aria-labelledby="lesson-title" data-lesson=${key} data-step=${place}>
      <div class="card-head"><h2 id="lesson-title" tabindex="-1" ref=${title}>${name}</h2><span class="when">${LESSONS.step(place + 1, steps.length)}</span></div>
      <div class="lesson-words" aria-live="polite"><p>${say}</p><p><b>${LESSONS.see}.</b> ${see}</p></div>
      <div class="lesson-actions">
        <button type="button" class="button" disabled=${place === 0} onClick=${() => goToStep(place - 1)}>${LESSONS.back}</button>
        <button type="button" class="button primary" onClick=${() => (last ? endLesson() : goToStep(place + 1))}>${last ? LESSONS.done : LESSONS.next}</button>
        <button type="button" class="quiet" onClick=${endLesson}>${LESSONS.all}</button>
        <${Numbers} />
      </div>
    </section>
  `;
}

/** What the step speaks of, as it is now: it need not stand on the panel the step looks at. */
function Numbers() {
  const measures = result.value?.measures ?? {};
  return html`
    <dl class="lesson-numbers" aria-label=${LESSONS.numbers}>
      ${measuresOf(present.value).map((key) => {
        const row = catalogue.value.get(key);
        return html`<div key=${key} data-measure=${key} title=${row.name}><dt><${Symbol} text=${row.symbol} /></dt><dd>${valueText(measures[key], row)}</dd></div>`;
      })}
    </dl>
  `;
}
