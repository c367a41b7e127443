/**
 * A map of one measure over two parameters, to be clicked: reads a signal-following `map()` = what
 * plots/activation-map.js takes, calls `onPick(xValue, yValue)`.
 */
import { html } from "../ui.js";
import { CELL_MARKS, activationMapFigure } from "../plots/activation-map.js";
import { palette } from "../plots/theme.js";
import { narrow } from "../state/look.js";
import { PlotlyPlace } from "./PlotlyPlace.js";

export function ActivationMap({ name, label, title, heading, map, words, onPick }) {
  const figure = () => activationMapFigure(map(), palette.value, words, narrow.value);
  return html`<${PlotlyPlace} name=${name} label=${label} title=${title} heading=${heading} figure=${figure} onPick=${({ x, y }) => onPick(x, y)} />`;
}

/** Names and counts of the cells without a value; `states` may hold others, which are not told. */
export function CellLegend({ states, words, counted }) {
  const present = Object.entries(CELL_MARKS).map(([state, { sign }]) => [state, sign, states.filter((s) => s === state).length]);
  return html`
    <ul class="cell-legend">
      ${present.filter(([, , n]) => n).map(([state, sign, n]) => html`<li key=${state} data-state=${state}><b aria-hidden="true">${sign}</b> ${counted(words[state], n)}</li>`)}
    </ul>
  `;
}
