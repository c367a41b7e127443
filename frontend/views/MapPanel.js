/** The map over two parameters: what to map, how far it is, the picture, its cells. */
import { html, useComputed, useEffect } from "../ui.js";
import { followSettings, loadCell } from "../map.js";
import { palette } from "../plots/theme.js";
import { samePoints } from "../sweep-table.js";
import { difference, kept, map, mapProblem, measure } from "../state/map.js";
import { narrow } from "../state/look.js";
import { catalogue } from "../state/request.js";
import { MAP } from "../texts.js";
import { ActivationMap } from "./ActivationMap.js";
import { MapCells } from "./MapCells.js";
import { MapSetup } from "./MapSetup.js";
import { MapTools } from "./MapTools.js";
import { Stage } from "./Stage.js";
import { axisLabel, pictureOf, shownCells } from "./map-picture.js";

export function MapPanel() {
  useEffect(followSettings, []);
  const made = useComputed(() => map.value !== null).value;
  return html`
    <div class="map-panel">
      <${MapSetup} />
      <p class="refusal" role="alert">${mapProblem.value}</p>
      <${MapTools} />
      <div class="map-body">
        <div class="map-picture">${made ? html`<${MapPicture} />` : html`<p class="map-empty">${MAP.empty}</p>`}</div>
        <aside class="map-side" aria-label=${MAP.cells}>
          ${made && html`<${MapCells} cells=${shownCells.value} />`}
          ${!narrow.value && html`<${Stage} compact=${true} />`}
        </aside>
      </div>
    </div>
  `;
}

function MapPicture() {
  const row = catalogue.value.get(measure.value);
  const [up, right] = map.value.table.axes.map(axisLabel);
  const taken = difference.value && kept.value && samePoints(kept.value.table, map.value.table);
  const name = `${row.name}${row.unit === "1" ? "" : ` (${row.unit})`}`;
  const heading = taken ? `${MAP.difference}: ${name}` : name;
  return html`
    <h3 class="map-title">${heading}</h3>
    <${ActivationMap} name="map" title=${MAP.title} heading=${heading} label=${MAP.picture(row.name, up, right)} map=${() => pictureOf(palette.value)} words=${MAP.states} onPick=${(x, y) => loadCell(map.peek(), [y, x])} />
  `;
}
