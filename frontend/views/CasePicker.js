/** The way into a figure's cases without a pointer: one choice an axis, then open. */
import { html, useState } from "../ui.js";
import { PAPER } from "../texts.js";
import { openCase } from "./FigureTools.js";

export function CasePicker({ figure }) {
  const [point, setPoint] = useState(figure.axes.map(({ values }) => values[values.length >> 1]));
  return html`
    <div class="case-picker" role="group" aria-label=${PAPER.pick}>
      ${figure.axes.map(({ parameter, values }, k) => html`
        <label class="pick" key=${parameter[0]}><span>${PAPER.axes[parameter[0]]}</span>
          <select value=${point[k]} onChange=${(event) => setPoint(point.map((v, i) => (i === k ? Number(event.target.value) : v)))}>
            ${values.map((v) => html`<option value=${v}>${v}</option>`)}
          </select>
        </label>
      `)}
      <button type="button" class="button" onClick=${() => openCase(figure, point)}>${PAPER.open}</button>
    </div>
  `;
}
