/** All claims with their verdicts on both variants. */
import { html } from "../ui.js";
import { paper } from "../state/paper.js";
import { WithSymbols } from "../symbol.js";
import { PAPER } from "../texts.js";
import { Verdict } from "./Claims.js";

export function PaperScore() {
  const { claims } = paper.value;
  const variants = Object.keys(claims[0].outcomes);
  const score = (variant) => Object.fromEntries(Object.keys(PAPER.verdicts).map((v) => [v, claims.filter(({ outcomes }) => outcomes[variant].verdict === v).length]));
  return html`
    <div class="score-table">
      <table>
        <caption>${variants.map((v) => html`<span key=${v}><b>${PAPER.variants[v] ?? v}</b> ${PAPER.score(score(v))}</span> `)}</caption>
        <thead><tr><th scope="col" colspan="2">${PAPER.claim}</th>${variants.map((v) => html`<th scope="col" key=${v}>${PAPER.variants[v] ?? v}</th>`)}</tr></thead>
        <tbody>
          ${claims.map(({ key, title, paper_says, outcomes }) => html`
            <tr key=${key} data-claim=${key}>
              <th scope="row">${key}</th><td><b><${WithSymbols} text=${title} /></b><span class="says"><${WithSymbols} text=${paper_says} /></span></td>
              ${variants.map((v) => html`<td key=${v}><${Verdict} verdict=${outcomes[v].verdict} /><span class="says"><${WithSymbols} text=${outcomes[v].sentence} /></span></td>`)}
            </tr>
          `)}
        </tbody>
      </table>
    </div>
  `;
}
