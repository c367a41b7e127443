/** How a map is shown and kept: its measure, following, the difference from another one, its files. */
import { html } from "../ui.js";
import { link } from "../api.js";
import { samePoints } from "../sweep-table.js";
import { MEASURES, difference, following, keepMap, kept, map, measure, setDifference, setFollowing, setMeasure } from "../state/map.js";
import { catalogue } from "../state/request.js";
import { MAP } from "../texts.js";
import { MapRun } from "./MapSetup.js";

export function MapTools() {
  const made = map.value;
  const matches = made && kept.value && samePoints(kept.value.table, made.table);
  return html`
    <div class="map-tools">
      <label class="pick"><span>${MAP.measure}</span>
        <select value=${measure.value} onChange=${(event) => setMeasure(event.target.value)}>
          ${MEASURES.map((key) => html`<option value=${key}>${catalogue.value.get(key).name}</option>`)}
        </select>
      </label>
      <label class="check" title=${MAP.followHelp}><input type="checkbox" checked=${following.value} onChange=${(event) => setFollowing(event.target.checked)} />${MAP.follow}</label>
      <span class="map-compare">
        <button type="button" class="quiet" disabled=${!made} title=${MAP.keepHelp} onClick=${keepMap}>${MAP.keep}</button>
        <button type="button" class="quiet" aria-pressed=${difference.value} disabled=${!matches} title=${kept.value && made && !matches ? MAP.otherPoints : MAP.differenceHelp} onClick=${() => setDifference(!difference.value)}>${MAP.difference}</button>
      </span>
      ${made?.job.status === "successful" && html`
        <span class="map-files">${MAP.files} <a href=${link(`jobs/${made.job.id}/result.csv`)} download>${MAP.csv}</a> <a href=${link(`jobs/${made.job.id}/result.nc`)} download>${MAP.netcdf}</a></span>
      `}
      <${MapRun} />
    </div>
  `;
}
