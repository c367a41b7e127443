/** Symbols as they are printed: "f_o" with a subscript. */
import { html } from "./ui.js";

export function MathsSymbol({ text }) {
  const [stem, index] = text.split("_", 2);
  return html`
    <i class="symbol">
      ${stem}${
        index &&
        html`
          <sub>${index}</sub>
        `
      }
    </i>
  `;
}

/** A sentence or formula with its symbols in that form. */
export function WithSymbols({ text }) {
  return text.split(/(\p{L}+_[\p{L}\d]+(?:,[\p{L}\d]+)?)/u).map((part) =>
    part.includes("_")
      ? html`
          <${MathsSymbol} text=${part} />
        `
      : part,
  );
}
