/** A symbol as it is printed: "f_o" with its index below the line. */
import { html } from "./ui.js";

export function Symbol({ text }) {
  const [stem, index] = text.split("_", 2);
  return html`<i class="symbol">${stem}${index && html`<sub>${index}</sub>`}</i>`;
}
