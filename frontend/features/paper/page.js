/** The Paper section, full width: its parts as tabs, and the scoreboard. */
import { html, useEffect } from "../../core/ui.js";
import { WithSymbols } from "../../core/maths-symbol.js";
import { TabList } from "../../core/widgets.js";
import { section, setSection } from "../../state/look.js";
import { cancelFigure, loadPaper } from "./figures.js";
import { PaperMaps } from "./maps.js";
import { Verdict } from "./parts.js";
import { PaperPca } from "./pca.js";
import { figures, paper, paperProblem } from "./state.js";
import { PaperStatic } from "./static.js";
import { PAPER } from "./texts.js";
import { PaperVoice } from "./voices.js";

const CONTENT = { static: PaperStatic, modal: PaperVoice, maps: PaperMaps, pca: PaperPca, scoreboard: PaperScore };

/** `children`: the top bar of the page. */
export function PaperPage({ children }) {
  useEffect(() => {
    loadPaper();
    return cancelFigure;
  }, []);
  const Content = CONTENT[section.value];
  return html`
    <div class="paper">
      ${children}
      <main class="paper-body card" aria-labelledby="paper-title">
        <div class="paper-head">
          <h2 id="paper-title">${PAPER.title}</h2>
          <span class="paper-source">${PAPER.source}</span>
          <${TabList} name="paper" texts=${PAPER.sections} chosen=${section.value} choose=${setSection} />
        </div>
        <div
          class=${`paper-content paper-${section.value}`}
          role="tabpanel"
          id="paper-content"
          aria-labelledby=${`paper-${section.value}`}
          tabindex="0"
        >
          <p class="refusal" role="alert">${paperProblem.value}</p>
          ${
            figures.value
              ? html`
                  <${Content} />
                `
              : !paperProblem.value &&
                html`
                  <p role="status">${PAPER.loading}</p>
                `
          }
        </div>
        <p class="paper-made">${paper.value && PAPER.shipped(paper.value.provenance)}</p>
      </main>
    </div>
  `;
}

export function PaperScore() {
  const { claims } = paper.value;
  const variants = Object.keys(claims[0].outcomes);
  const score = (variant) =>
    Object.fromEntries(
      Object.keys(PAPER.verdicts).map((v) => [
        v,
        claims.filter(({ outcomes }) => outcomes[variant].verdict === v).length,
      ]),
    );
  return html`
    <div class="score-table">
      <table>
        <caption>
          ${variants.map(
            (v) => html`
              <span key=${v}>
                <b>${PAPER.variants[v] ?? v}</b>
                ${" "}${PAPER.score(score(v))}
              </span>
              ${" "}
            `,
          )}
        </caption>
        <thead>
          <tr>
            <th scope="col" colspan="2">${PAPER.claim}</th>
            ${variants.map(
              (v) => html`
                <th scope="col" key=${v}>${PAPER.variants[v] ?? v}</th>
              `,
            )}
          </tr>
        </thead>
        <tbody>
          ${claims.map(
            ({ key, title, paper_says, outcomes }) => html`
              <tr key=${key} data-claim=${key}>
                <th scope="row">${key}</th>
                <td>
                  <b><${WithSymbols} text=${title} /></b>
                  <span class="says"><${WithSymbols} text=${paper_says} /></span>
                </td>
                ${variants.map(
                  (v) => html`
                    <td key=${v}>
                      <${Verdict} verdict=${outcomes[v].verdict} />
                      <span class="says"><${WithSymbols} text=${outcomes[v].sentence} /></span>
                    </td>
                  `,
                )}
              </tr>
            `,
          )}
        </tbody>
      </table>
    </div>
  `;
}
