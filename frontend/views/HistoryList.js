/** The voices of this visit, newest first; a tap goes back to one. */
import { html } from "../ui.js";
import { numberText } from "../plots/axis.js";
import { presetOf } from "../params.js";
import { at, entries, goTo } from "../state/history.js";
import { schema } from "../state/request.js";
import { HISTORY, STATES } from "../texts.js";
import { changeSummary } from "./settings-text.js";

export function HistoryList() {
  const known = entries.value;
  return html`
    <section class="history" aria-labelledby="history-title">
      <h2 id="history-title">${HISTORY.title}</h2>
      ${known.length < 2 && html`<p class="caution">${HISTORY.empty}</p>`}
      <ol reversed>
        ${known.map((entry, k) => html`<${Entry} key=${k} place=${k} entry=${entry} before=${known[k - 1]?.values} />`).reverse()}
      </ol>
    </section>
  `;
}

function Entry({ place, entry, before }) {
  const label = changeSummary(schema.value, before, entry.values, presetOf(schema.value, entry.values)?.label, HISTORY);
  return html`
    <li>
      <button type="button" class="plain" aria-current=${place === at.value ? "true" : undefined} onClick=${() => goTo(place)}>
        <b>${label}</b> <span>${entry.pitch ? `${numberText(entry.pitch)} Hz` : STATES[entry.state]}</span>
      </button>
    </li>
  `;
}
