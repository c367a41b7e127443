/** Why the server refused a value, at the field. */
import { html } from "../ui.js";
import { CONTROL } from "../texts.js";

export function Refusal({ problem }) {
  return html`<span class="refusal" role="alert">${problem.message}. ${problem.allowed && CONTROL.allowed(problem.allowed)}</span>`;
}
