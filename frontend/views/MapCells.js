/** The cells of a map in words: what their marks mean and how many there are, why there is no value, and one to choose. */
import { html, useState } from "../ui.js";
import { loadCell } from "../map.js";
import { numberText } from "../plots/axis.js";
import { map, measure } from "../state/map.js";
import { catalogue } from "../state/request.js";
import { MAP, STATES } from "../texts.js";
import { CellLegend } from "./ActivationMap.js";
import { axisLabel } from "./map-picture.js";

export function MapCells({ cells }) {
  const { states } = cells;
  const { reasons, problems } = map.value.table;
  const periodic = ({ points }) => points.some((k) => states[k] === "unvalued");
  const why = [...(reasons[measure.value] ?? []).filter(periodic).map(({ reason }) => reason), ...problems.slice(0, 1).map(({ detail }) => detail)];
  return html`
    <p>${MAP.voiced(map.value.table.states.filter((state) => state === "periodic").length, states.length)}</p>
    <${CellLegend} states=${states} words=${MAP.states} counted=${MAP.counted} />
    <p class="current-mark"><b aria-hidden="true">⊕</b> ${MAP.states.current}</p>
    ${why.map((reason) => html`<p class="caution">${reason}</p>`)}
    <${CellPicker} cells=${cells} />
  `;
}

/** The way into a cell, and to its value, without a pointer. */
function CellPicker({ cells }) {
  const { axes } = map.value.table;
  const [chosen, setChosen] = useState([0, 0]);
  const place = axes.map(({ values }, k) => Math.min(chosen[k], values.length - 1));
  const cell = place[0] * axes[1].values.length + place[1];
  return html`
    <div class="case-picker" role="group" aria-label=${MAP.pick}>
      ${axes.map((axis, k) => html`
        <label class="pick" key=${axis.paths[0]}><span>${axisLabel(axis)}</span>
          <select value=${place[k]} onChange=${(event) => setChosen(place.map((v, i) => (i === k ? Number(event.target.value) : v)))}>
            ${axis.values.map((value, at) => html`<option value=${at}>${Number(value.toPrecision(4))}</option>`)}
          </select>
        </label>
      `)}
      <output>${valueText(cells, cell)}</output>
      <button type="button" class="button" onClick=${() => loadCell(map.peek(), place.map((at, k) => axes[k].values[at]))}>${MAP.load}</button>
    </div>
  `;
}

function valueText({ values, states }, cell) {
  const { unit, decimals } = catalogue.value.get(measure.value);
  if (values[cell] !== null) return `${numberText(values[cell], decimals)}${unit === "1" ? "" : ` ${unit}`}`;
  return MAP.states[states[cell]] ?? STATES[states[cell]] ?? MAP.waiting;
}
