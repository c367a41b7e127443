/** Parts of every figure of the paper: its claims, its tools, and a choice of one of its points. */
import { batch, html, useState } from "../../core/ui.js";
import { postJson, Problem } from "../../core/api.js";
import { WithSymbols } from "../../core/maths-symbol.js";
import { known } from "../../core/parameters.js";
import { setSection } from "../../state/look.js";
import { restorePatch, schema } from "../../state/request.js";
import { showNotice } from "../../state/session.js";
import { cancelFigure, remake, requestAt } from "./figures.js";
import { backToShipped, fresh, paper, paperRun } from "./state.js";
import { PAPER } from "./texts.js";

export function Verdict({ verdict }) {
  return html`
    <span class=${`verdict ${verdict}`}>${PAPER.verdicts[verdict]}</span>
  `;
}

/** Claims with verdict and measured sentence. `compact`: the sentence is inside the details. */
export function Claims({ keys, compact = false }) {
  const shown = paper.value.claims.filter(({ key }) => keys.includes(key));
  return html`
    <ul class="claims" aria-label=${PAPER.claims}>
      ${shown.map(
        ({ key, title, paper_says, definition, outcomes }) => html`
          <li key=${key} data-claim=${key}>
            <details>
              <summary>
                <${Verdict} verdict=${outcomes.paper.verdict} />
                ${" "}
                <b>${key}</b>
                ${" "}
                <span><${WithSymbols} text=${title} /></span>
              </summary>
              ${
                compact &&
                html`
                  <p class="measured"><${WithSymbols} text=${outcomes.paper.sentence} /></p>
                `
              }
              <p>
                <b>${PAPER.says}.</b>
                ${" "}
                <${WithSymbols} text=${paper_says} />
              </p>
              <p>
                <b>${PAPER.test}.</b>
                ${" "}${definition}
              </p>
            </details>
            ${
              !compact &&
              html`
                <p class="measured"><${WithSymbols} text=${outcomes.paper.sentence} /></p>
              `
            }
          </li>
        `,
      )}
    </ul>
  `;
}

/** Open the voice of a point of `figure` in the instrument. */
export async function openCase(figure, point) {
  try {
    const { patch } = await postJson("resolve", requestAt(figure, point));
    batch(() => {
      restorePatch(known(schema.peek(), patch));
      setSection(null);
    });
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    showNotice(error.message);
  }
}

export function FigureTools({ figure }) {
  const run = paperRun.value?.key === figure.key ? paperRun.value : null;
  const own = fresh.value[figure.key];
  return html`
    <div class="figure-tools" data-figure=${figure.key}>
      ${
        run
          ? html`
              <progress max=${run.total} value=${run.done} aria-label=${PAPER.again}></progress>
              <span class="count">${PAPER.progress(run.done, run.total)}</span>
              <button type="button" class="quiet" onClick=${cancelFigure}>${PAPER.cancel}</button>
            `
          : html`
              <span class="made">${own && PAPER.here(own.made)}</span>
              ${
                own &&
                html`
                  <button type="button" class="quiet" onClick=${() => backToShipped(figure.key)}>${PAPER.back}</button>
                `
              }
              <button type="button" class="quiet" disabled=${paperRun.value !== null} onClick=${() => remake(figure)}>
                ${PAPER.again}
              </button>
            `
      }
    </div>
  `;
}

export function CasePicker({ figure }) {
  const [point, setPoint] = useState(figure.axes.map(({ values }) => values[values.length >> 1]));
  return html`
    <div class="case-picker" role="group" aria-label=${PAPER.pick}>
      ${figure.axes.map(
        ({ parameter, values }, k) => html`
          <label class="pick" key=${parameter[0]}>
            <span>${PAPER.axes[parameter[0]]}</span>
            <select
              value=${point[k]}
              onChange=${(event) => setPoint(point.map((v, i) => (i === k ? Number(event.target.value) : v)))}
            >
              ${values.map(
                (v) => html`
                  <option value=${v}>${v}</option>
                `,
              )}
            </select>
          </label>
        `,
      )}
      <button type="button" class="button" onClick=${() => openCase(figure, point)}>${PAPER.open}</button>
    </div>
  `;
}
