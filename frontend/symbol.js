/** Symbols as they are printed: "f_o" with its index below the line. */
import { html } from "./ui.js";

export function Symbol({ text }) {
  const [stem, index] = text.split("_", 2);
  return html`<i class="symbol">${stem}${index && html`<sub>${index}</sub>`}</i>`;
}

/** A sentence or formula with its symbols printed so. */
export function WithSymbols({ text }) {
  return text.split(/(\p{L}+_[\p{L}\d]+(?:,[\p{L}\d]+)?)/u).map((part) => (part.includes("_") ? html`<${Symbol} text=${part} />` : part));
}
