/** Claims of the paper with the verdict and the measured sentence; `compact`: the sentence within what unfolds. */
import { html } from "../ui.js";
import { paper } from "../state/paper.js";
import { WithSymbols } from "../symbol.js";
import { PAPER } from "../texts.js";

export function Verdict({ verdict }) {
  return html`<span class=${`verdict ${verdict}`}>${PAPER.verdicts[verdict]}</span>`;
}

export function Claims({ keys, compact = false }) {
  const shown = paper.value.claims.filter(({ key }) => keys.includes(key));
  return html`
    <ul class="claims" aria-label=${PAPER.claims}>
      ${shown.map(({ key, title, paper_says, definition, outcomes }) => html`
        <li key=${key} data-claim=${key}>
          <details>
            <summary><${Verdict} verdict=${outcomes.paper.verdict} /> <b>${key}</b> <span><${WithSymbols} text=${title} /></span></summary>
            ${compact && html`<p class="measured"><${WithSymbols} text=${outcomes.paper.sentence} /></p>`}
            <p><b>${PAPER.says}.</b> <${WithSymbols} text=${paper_says} /></p>
            <p><b>${PAPER.test}.</b> ${definition}</p>
          </details>
          ${!compact && html`<p class="measured"><${WithSymbols} text=${outcomes.paper.sentence} /></p>`}
        </li>
      `)}
    </ul>
  `;
}
