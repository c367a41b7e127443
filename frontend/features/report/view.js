/**
 * A report of one page, to print: settings, pictures, measures, the comparison if there is one, notes. Always on
 * white.
 */
import { html, readonly, signal, useEffect, useRef } from "../../core/ui.js";
import { steadyLimits } from "../../core/axis.js";
import { Dialog } from "../../core/dialog.js";
import { MathsSymbol } from "../../core/maths-symbol.js";
import { isOfModel } from "../../core/parameters.js";
import { isVoiced } from "../../core/result.js";
import { APP, STATES } from "../../core/texts.js";
import { paperPalette, smallFont } from "../../core/theme.js";
import { posture, result } from "../../state/answers.js";
import { catalogue, patch, preset, schema, values } from "../../state/request.js";
import { held } from "../compare/state.js";
import { COMPARE } from "../compare/texts.js";
import { changeText } from "../compare/view.js";
import { shortName, valueOf } from "../controls/settings-text.js";
import { HEADLINES, MEASURE } from "../measures/texts.js";
import { cautionOf, rangeOf, valueText } from "../measures/value-text.js";
import { REPORT } from "./texts.js";
import { spectrumOf } from "../spectrum/levels.js";
import { drawSpectrum } from "../spectrum/paint.js";
import { SPECTRUM } from "../spectrum/texts.js";
import { tract } from "../spectrum/tract.js";
import { CLOSURE, STAGE } from "../stage/texts.js";
import { paintStage, paperStage } from "../stage/view.js";
import { drawWaves, stackLayout, waveRows } from "../waves/stack.js";
import { WAVES } from "../waves/texts.js";

const KEY = "vocalis.notes";
const _notes = signal(localStorage.getItem(KEY) ?? "");

export const notes = readonly(_notes);

export function setNotes(text) {
  _notes.value = text;
  if (text) localStorage.setItem(KEY, text);
  else localStorage.removeItem(KEY);
}

const PRINT_RATIO = 3;
const UNIT = 13; // px of a picture per rem of the page
const MEASURES = [
  ...HEADLINES.map(({ key }) => key),
  "spl_lips_db",
  "ac_flow_ml_s",
  "min_flow_ml_s",
  "mfdr_l_s2",
  "naq",
  "h1_h2_sound_db",
  "cpp_db",
  "contact_location",
  "contact_impulse_pa_s",
  "glottal_gap_area_mm2",
  "strain",
  "length_mm",
  "glottal_half_angle_deg",
  "gap_mm",
];

export function ReportDialog() {
  const shown = result.value;
  if (!shown) return null;
  const { model_version: model, code_version: code } = shown.provenance;
  return html`
    <${Dialog} title=${REPORT.title} wide=${true}>
      <p class="report-tools">
        <button type="button" class="button" onClick=${() => window.print()}>${REPORT.print}</button>
        <span class="caution">${REPORT.notesHelp}</span>
      </p>
      <article class="report on-white" aria-label=${REPORT.title}>
        <header>
          <h3>
            ${REPORT.head}${
              preset.value &&
              html`
                :${" "}${preset.value.label}
              `
            }
          </h3>
          <p>
            <b>${STATES[shown.state]}.</b>
            ${" "}${posture.value && `${STAGE.atRest} ${CLOSURE[posture.value.static_shape.closure_pattern]}.`}
            ${" "}${isVoiced(shown) ? MEASURE.cycles(shown.cycles) : shown.explanation}
          </p>
        </header>
        <${Settings} />
        <div class="report-pictures">
          <figure>
            <figcaption>${REPORT.stage}</figcaption>
            <${Still} name="report-stage" width=${380} height=${240} paint=${paintReportStage} label=${STAGE.picture} />
            <figcaption>${SPECTRUM.spectrum}</figcaption>
            <${Still}
              name="report-spectrum"
              width=${380}
              height=${135}
              paint=${paintReportSpectrum}
              label=${SPECTRUM.spectrumPicture}
            />
          </figure>
          <figure>
            <figcaption>${REPORT.waves},${" "}${REPORT.milliseconds}</figcaption>
            <${Still} name="report-waves" width=${380} height=${400} paint=${paintReportWaves} label=${WAVES.picture} />
          </figure>
        </div>
        <${Measures} shown=${shown} />
        <label class="report-notes">
          <span>${REPORT.notes}</span>
          <textarea rows="3" value=${notes.value} onInput=${(event) => setNotes(event.target.value)}></textarea>
        </label>
        <footer>
          <p>
            ${REPORT.made(model, code, new Date().toISOString().slice(0, 10))}${" "}${APP.use}${" "}
            ${cautionOf(shown, schema.value)}
          </p>
          <p>
            ${REPORT.again}${" "}
            <span class="report-link">${location.href}</span>
          </p>
        </footer>
      </article>
    <//>
  `;
}

/** Muscles, breath and vowel; what was set besides; and all equations once one was chosen. */
function Settings() {
  const modelChosen = Object.keys(patch.value).some(isOfModel);
  const rows = [...schema.value.parameters.values()].filter(
    (row) =>
      row.group === "muscles" ||
      ["subglottal_pressure_pa", "vowel"].includes(row.key) ||
      (isOfModel(row.key) ? modelChosen : row.key in patch.value),
  );
  return html`
    <dl class="report-settings">
      ${rows.map(
        (row) => html`
          <div key=${row.key}>
            <dt>${shortName(row)}</dt>
            <dd>${valueOf(row, values.value)}</dd>
          </div>
        `,
      )}
    </dl>
  `;
}

function Measures({ shown }) {
  const { a } = held.value;
  return html`
    <table class="report-measures">
      <thead>
        <tr>
          <th scope="col">${REPORT.measures}</th>
          <th scope="col">${a ? "B" : ""}</th>
          ${
            a &&
            html`
              <th scope="col">A</th>
              <th scope="col">${COMPARE.difference}</th>
            `
          }
          <th scope="col">${REPORT.usual}</th>
        </tr>
      </thead>
      <tbody>
        ${MEASURES.map((key) => {
          const row = catalogue.value.get(key);
          const measure = shown.measures[key];
          return html`
            <tr key=${key}>
              <th scope="row">
                ${row.name}${" "}
                <${MathsSymbol} text=${row.symbol} />
              </th>
              <td>${valueText(measure, row)}</td>
              ${
                a &&
                html`
                  <td>${valueText(a.result.measures[key], row)}</td>
                  <td>${changeText(row, a.result.measures[key], measure)}</td>
                `
              }
              <td>${remarkOf(row, measure, shown)}</td>
            </tr>
          `;
        })}
      </tbody>
    </table>
  `;
}

/** Why there is no value, unless the head of the report gives it already; else the published range. */
function remarkOf(row, measure, shown) {
  if (measure?.reason) return measure.reason === shown.explanation ? "" : measure.reason;
  return row.normal_range && REPORT.published(rangeOf(row), row.normal_range.source);
}

/** A picture that is painted once, sharp enough for print. */
function Still({ name, width, height, paint, label }) {
  const canvas = useRef(null);
  useEffect(() => {
    const context = canvas.current.getContext("2d");
    context.isFigure = true;
    context.setTransform(PRINT_RATIO, 0, 0, PRINT_RATIO, 0, 0);
    context.clearRect(0, 0, width, height);
    paint(context, { width, height });
  });
  return html`
    <canvas
      ref=${canvas}
      data-picture=${name}
      width=${width * PRINT_RATIO}
      height=${height * PRINT_RATIO}
      role="img"
      aria-label=${label}
    ></canvas>
  `;
}

function paintReportStage(context, box) {
  const model = paperStage(paperPalette());
  if (model) paintStage(context, box, model);
}

function paintReportSpectrum(context, box) {
  const spectrum = spectrumOf(result.peek());
  const top = 10 * Math.ceil(Math.max(...spectrum.levelDb) / 10);
  drawSpectrum(
    context,
    box,
    { spectrum, tract: tract.peek(), colours: paperPalette(), top },
    UNIT,
    smallFont(400, UNIT),
    SPECTRUM,
  );
}

function paintReportWaves(context, box) {
  const shown = result.peek();
  const stack = waveRows(shown);
  const limits = stack.rows.map((row) => steadyLimits(undefined, row.range, row));
  const layout = stackLayout(box.width, box.height, stack.rows.length, stack.window, UNIT);
  const colours = paperPalette();
  drawWaves(context, layout, shown, stack, limits, colours, smallFont(400, UNIT));
  context.font = smallFont(600, UNIT);
  context.textAlign = "left";
  context.textBaseline = "bottom";
  context.fillStyle = colours.ink;
  stack.rows.forEach((row, k) =>
    context.fillText(`${WAVES[row.key]}, ${row.unit}`, layout.left, layout.rows[k].top - 2),
  );
}
