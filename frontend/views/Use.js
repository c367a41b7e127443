/** What the page is for, and what it lacks where it came without encryption. */
import { html } from "../ui.js";
import { APP } from "../texts.js";

export const Use = () => html`<p class="use">${APP.use}${!window.isSecureContext && html`<span class="unencrypted">${APP.unencrypted}</span>`}</p>`;
