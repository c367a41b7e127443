/** What can be kept of the voice shown: report, pictures, data, code. */
import { html } from "../ui.js";
import { link } from "../api.js";
import { handOver, keepFigure, wavesCsv } from "../kept.js";
import { figures } from "../plots/figures.js";
import { palette } from "../plots/theme.js";
import { openDialog } from "../state/look.js";
import { result } from "../state/outcome.js";
import { KEEP } from "../texts.js";
import { Dialog } from "./Dialog.js";

export function KeepDialog() {
  const shown = result.value;
  const file = (ending) => link(`jobs/${shown.id}/${ending}`);
  return html`
    <${Dialog} title=${KEEP.title}>
      <p class="run-actions">
        <button type="button" class="button" onClick=${() => openDialog("report")}>${KEEP.report}</button>
        <button type="button" class="button" onClick=${() => openDialog("code")}>${KEEP.code}</button>
      </p>
      <h3>${KEEP.data}</h3>
      ${shown && html`
        <p class="run-actions">
          <a href=${file("audio.wav")} download>${KEEP.wav}</a>
          <a href=${file("result.nc")} download>${KEEP.netcdf}</a>
          <a href=${file("result.csv")} download>${KEEP.csv}</a>
          <button type="button" class="plain" onClick=${() => handOver("vocalis-waves.csv", wavesCsv(shown), "text/csv")}>${KEEP.waves}</button>
        </p>
      `}
      <h3>${KEEP.figures}</h3>
      <ul class="figure-list">
        ${figures.value.map((figure) => html`
          <li key=${figure.name} data-figure=${figure.name}>
            <span>${figure.title}</span>
            ${["svg", "png"].map((kind) => html`<button key=${kind} type="button" class="button small" aria-label=${KEEP.figure(figure.title, KEEP[kind])} onClick=${() => keepFigure(figure, kind, palette.peek().panel)}>${KEEP[kind]}</button>`)}
          </li>
        `)}
      </ul>
    <//>
  `;
}
