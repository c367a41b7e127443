/** Source and filter: spectrum with harmonics and resonances, spectrogram, the tract's area. */
import { computed, html } from "../ui.js";
import { niceCeil } from "../plots/axis.js";
import { drawSpectrogram, drawSpectrum, drawTract } from "../plots/spectrum-draw.js";
import { spectrogramOf, spectrumOf } from "../plots/spectrum.js";
import { palette, rootPx, smallFont } from "../plots/theme.js";
import { rested } from "../state/rested.js";
import { tract } from "../state/tract.js";
import { VOICE } from "../texts.js";
import { Picture } from "./Picture.js";

const STEP_DB = 10;

const spectrum = computed(() => (rested.value ? spectrumOf(rested.value) : null));
const spectrogram = computed(() => (rested.value ? spectrogramOf(rested.value) : null));

function spectrumModel() {
  if (!spectrum.value) return null;
  const loudest = Math.max(...spectrum.value.levelDb);
  return { spectrum: spectrum.value, tract: tract.value, colours: palette.value, top: Math.ceil(loudest / STEP_DB) * STEP_DB };
}

function spectrogramModel() {
  return spectrogram.value && { spectrogram: spectrogram.value, tract: tract.value, cycle: rested.value.cycle, colours: palette.value };
}

function tractModel() {
  return tract.value && { tract: tract.value, top: niceCeil(1e4 * Math.max(...tract.value.areas_m2)), colours: palette.value };
}

const painter = (draw) => (context, box, model) => draw(context, box, model, rootPx(), smallFont(), VOICE);

export function VoicePanel() {
  const [least, most] = VOICE.span(60);
  return html`
    <div class="stacked voice-panel">
      <figure class="plot">
        <figcaption>
          <h2>${VOICE.spectrum}</h2>
          <ul class="legend inline">
            <li><i class="key dot"></i>${VOICE.keys.harmonics}</li>
            <li><i class="key gain"></i>${VOICE.keys.gain}</li>
          </ul>
        </figcaption>
        <${Picture} name="spectrum" title=${VOICE.spectrum} model=${spectrumModel} paint=${painter(drawSpectrum)} label=${VOICE.spectrumPicture} />
      </figure>
      <figure class="plot">
        <figcaption><h2>${VOICE.spectrogram}</h2><span class="when width-key">${least} <i></i> ${most}</span></figcaption>
        <${Picture} name="spectrogram" title=${VOICE.spectrogram} model=${spectrogramModel} paint=${painter(drawSpectrogram)} label=${VOICE.spectrogramPicture} />
      </figure>
      <figure class="plot">
        <figcaption><h2>${VOICE.tract} ${tract.value && html`/${tract.value.ipa}/`}</h2><span class="when resonances">${tract.value && `${VOICE.formantsTitle}: ${tract.value.formants.slice(0, 4).map((row) => Math.round(row.frequency_hz)).join(" · ")}`}</span></figcaption>
        <${Picture} name="tract" title=${VOICE.tract} model=${tractModel} paint=${painter(drawTract)} label=${VOICE.tractPicture} />
      </figure>
    </div>
  `;
}
