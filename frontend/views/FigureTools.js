/** What stands at every figure: make it anew, stop that, go back; and the way into the instrument. */
import { html } from "../ui.js";
import { requestAt } from "../figure.js";
import { cancelFigure, remake } from "../paper.js";
import { backToShipped, fresh, paperRun, setSection } from "../state/paper.js";
import { takeRequest } from "../state/request.js";
import { PAPER } from "../texts.js";

/** Put the posture of a point of `figure` into the instrument and show it. */
export function openCase(figure, point) {
  takeRequest(requestAt(figure, point));
  setSection(null);
}

export function FigureTools({ figure }) {
  const run = paperRun.value?.key === figure.key ? paperRun.value : null;
  const own = fresh.value[figure.key];
  return html`
    <div class="figure-tools" data-figure=${figure.key}>
      ${run
        ? html`
            <progress max=${run.total} value=${run.done} aria-label=${PAPER.again}></progress>
            <span class="count">${PAPER.progress(run.done, run.total)}</span>
            <button type="button" class="quiet" onClick=${cancelFigure}>${PAPER.cancel}</button>
          `
        : html`
            <span class="made">${own && PAPER.here(own.made)}</span>
            ${own && html`<button type="button" class="quiet" onClick=${() => backToShipped(figure.key)}>${PAPER.back}</button>`}
            <button type="button" class="quiet" disabled=${paperRun.value !== null} onClick=${() => remake(figure)}>${PAPER.again}</button>
          `}
    </div>
  `;
}
