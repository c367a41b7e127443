/** The keys, how to read the page, and what the page is for. */
import { html } from "../../core/ui.js";
import { Dialog } from "../../core/dialog.js";
import { APP } from "../../core/texts.js";
import { HELP } from "./texts.js";

export function HelpDialog() {
  return html`
    <${Dialog} title=${HELP.title}>
      <dl class="keys">
        ${HELP.keys.map(
          ([key, what]) => html`
            <dt><kbd>${key}</kbd></dt>
            <dd>${what}</dd>
          `,
        )}
      </dl>
      <h3>${HELP.howTitle}</h3>
      ${HELP.how.map(
        (text) => html`
          <p>${text}</p>
        `,
      )}
      <${Use} />
    <//>
  `;
}

export function Use({ short = false }) {
  return html`
    <p class="use">
      ${APP.use}
      ${
        !window.isSecureContext &&
        html`
          ${" "}
          <span class="unencrypted" title=${APP.unencrypted}>${short ? APP.unencryptedShort : APP.unencrypted}</span>
        `
      }
    </p>
  `;
}
