/** What the page is for, and what it lacks where it came without encryption: in a few words where room is short. */
import { html } from "../ui.js";
import { APP } from "../texts.js";

export function Use({ short = false }) {
  return html`
    <p class="use">
      ${APP.use}
      ${!window.isSecureContext && html` <span class="unencrypted" title=${APP.unencrypted}>${short ? APP.unencryptedShort : APP.unencrypted}</span>`}
    </p>
  `;
}
