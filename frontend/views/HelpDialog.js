/** The keys, and how to read the page. */
import { html } from "../ui.js";
import { HELP } from "../texts.js";
import { Dialog } from "./Dialog.js";
import { Use } from "./Use.js";

export function HelpDialog() {
  return html`
    <${Dialog} title=${HELP.title}>
      <dl class="keys">${HELP.keys.map(([key, what]) => html`<dt><kbd>${key}</kbd></dt><dd>${what}</dd>`)}</dl>
      <h3>${HELP.howTitle}</h3>
      ${HELP.how.map((text) => html`<p>${text}</p>`)}
      <${Use} />
    <//>
  `;
}
