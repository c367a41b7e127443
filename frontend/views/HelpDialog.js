/** The keys, and how to read the page. */
import { html } from "../ui.js";
import { APP, HELP } from "../texts.js";
import { Dialog } from "./Dialog.js";

export function HelpDialog() {
  return html`
    <${Dialog} title=${HELP.title}>
      <dl class="keys">${HELP.keys.map(([key, what]) => html`<dt><kbd>${key}</kbd></dt><dd>${what}</dd>`)}</dl>
      <h3>${HELP.howTitle}</h3>
      ${HELP.how.map((text) => html`<p>${text}</p>`)}
      <p class="caution">${APP.use}</p>
    <//>
  `;
}
