/** What can be exported of the voice on the page: report, pictures, data, code. */
import { html, useState } from "../../core/ui.js";
import { link } from "../../core/api.js";
import { copyText } from "../../core/clipboard.js";
import { Dialog, openDialog } from "../../core/dialog.js";
import { download, exportFigure, figures } from "../../core/export.js";
import { simulationRequest } from "../../core/parameters.js";
import { palette } from "../../core/theme.js";
import { result } from "../../state/answers.js";
import { patch } from "../../state/request.js";
import { curlCode, pythonCode, wavesCsv } from "./formats.js";
import { CODE, EXPORT } from "./texts.js";
import { LIVE_S } from "../live/follow-request.js";

export function ExportDialog() {
  const shown = result.value;
  const file = (ending) => link(`jobs/${shown.id}/${ending}`);
  return html`
    <${Dialog} title=${EXPORT.title}>
      <p class="run-actions">
        <button type="button" class="button" onClick=${() => openDialog("report")}>${EXPORT.report}</button>
        <button type="button" class="button" onClick=${() => openDialog("code")}>${EXPORT.code}</button>
      </p>
      <h3>${EXPORT.data}</h3>
      ${
        shown &&
        html`
          <p class="run-actions">
            <a href=${file("audio.wav")} download>${EXPORT.wav}</a>
            <a href=${file("result.nc")} download>${EXPORT.netcdf}</a>
            <a href=${file("result.csv")} download>${EXPORT.csv}</a>
            <button
              type="button"
              class="plain"
              onClick=${() => download("vocalis-waves.csv", wavesCsv(shown), "text/csv")}
            >
              ${EXPORT.waves}
            </button>
          </p>
        `
      }
      <h3>${EXPORT.figures}</h3>
      <ul class="figure-list">
        ${figures.value.map(
          (figure) => html`
            <li key=${figure.name} data-figure=${figure.name}>
              <span>${figure.title}</span>
              ${["svg", "png"].map(
                (kind) => html`
                  <button
                    key=${kind}
                    type="button"
                    class="button small"
                    aria-label=${EXPORT.figure(figure.title, EXPORT[kind])}
                    onClick=${() => exportFigure(figure, kind, palette.peek().panel)}
                  >
                    ${EXPORT[kind]}
                  </button>
                `,
              )}
            </li>
          `,
        )}
      </ul>
    <//>
  `;
}

export function CodeDialog() {
  const request = simulationRequest(patch.value, { duration_s: LIVE_S });
  return html`
    <${Dialog} title=${CODE.title} wide=${false}>
      <${Listing} name="python" title=${CODE.python} help=${CODE.pythonHelp} text=${pythonCode(request)} />
      <${Listing} name="curl" title=${CODE.curl} help=${CODE.curlHelp} text=${curlCode(request, link(""))} />
    <//>
  `;
}

function Listing({ name, title, help, text }) {
  const [outcome, setOutcome] = useState("");
  const copy = async () => setOutcome((await copyText(text)) ? CODE.copied : CODE.copyFailed);
  return html`
    <section class="listing">
      <div class="card-head">
        <h3>${title}</h3>
        <span role="status" class="when">${outcome}</span>
        <button type="button" class="button small" onClick=${copy}>${CODE.copy}</button>
      </div>
      <pre tabindex="0" data-code=${name}>${text}</pre>
      <p class="caution">${help}</p>
    </section>
  `;
}
