/** The Paper section, full width: its parts as tabs, each figure with its claims and the run that makes it anew. */
import { html, useEffect } from "../ui.js";
import { TopBar } from "../controls/TopBar.js";
import { cancelFigure, loadPaper } from "../paper.js";
import { figures, paper, paperProblem, section, setSection } from "../state/paper.js";
import { PAPER } from "../texts.js";
import { PaperMaps } from "./PaperMaps.js";
import { PaperPca } from "./PaperPca.js";
import { PaperScore } from "./PaperScore.js";
import { PaperStatic } from "./PaperStatic.js";
import { PaperVoice } from "./PaperVoice.js";
import { TabList } from "./TabList.js";

const CONTENT = { static: PaperStatic, modal: PaperVoice, maps: PaperMaps, pca: PaperPca, scoreboard: PaperScore };

export function PaperPage() {
  useEffect(() => {
    loadPaper();
    return cancelFigure;
  }, []);
  const Content = CONTENT[section.value];
  return html`
    <div class="paper">
      <${TopBar} />
      <main class="paper-body card" aria-labelledby="paper-title">
        <div class="paper-head">
          <h2 id="paper-title">${PAPER.title}</h2>
          <span class="paper-source">${PAPER.source}</span>
          <${TabList} name="paper" texts=${PAPER.sections} chosen=${section.value} choose=${setSection} />
        </div>
        <div class=${`paper-content paper-${section.value}`} role="tabpanel" id="paper-content" aria-labelledby=${`paper-${section.value}`} tabindex="0">
          <p class="refusal" role="alert">${paperProblem.value}</p>
          ${figures.value ? html`<${Content} />` : !paperProblem.value && html`<p role="status">${PAPER.loading}</p>`}
        </div>
        <p class="paper-made">${paper.value && PAPER.shipped(paper.value.provenance)}</p>
      </main>
    </div>
  `;
}
