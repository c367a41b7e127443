/** Source and filter: spectrum with harmonics and resonances, spectrogram, area of the tract. */
import { computed, html } from "../../core/ui.js";
import { niceCeil } from "../../core/axis.js";
import { Picture } from "../../core/picture.js";
import { palette, rootPx, smallFont } from "../../core/theme.js";
import { settled } from "../../state/settled.js";
import { spectrogramOf, spectrumOf } from "./levels.js";
import { drawSpectrogram, drawSpectrum, drawTract } from "./paint.js";
import { SPECTRUM } from "./texts.js";
import { tract } from "./tract.js";

const STEP_DB = 10;

const spectrum = computed(() => (settled.value ? spectrumOf(settled.value) : null));
const spectrogram = computed(() => (settled.value ? spectrogramOf(settled.value) : null));

function spectrumModel() {
  if (!spectrum.value) return null;
  const loudest = Math.max(...spectrum.value.levelDb);
  return {
    spectrum: spectrum.value,
    tract: tract.value,
    colours: palette.value,
    top: Math.ceil(loudest / STEP_DB) * STEP_DB,
  };
}

function spectrogramModel() {
  return (
    spectrogram.value && {
      spectrogram: spectrogram.value,
      tract: tract.value,
      cycle: settled.value.cycle,
      colours: palette.value,
    }
  );
}

function tractModel() {
  return (
    tract.value && {
      tract: tract.value,
      top: niceCeil(1e4 * Math.max(...tract.value.areas_m2)),
      colours: palette.value,
    }
  );
}

const painter = (draw) => (context, box, model) => draw(context, box, model, rootPx(), smallFont(), SPECTRUM);

export function SpectrumPanel() {
  const [least, most] = SPECTRUM.span(60);
  return html`
    <div class="stacked voice-panel">
      <figure class="plot">
        <figcaption>
          <h2>${SPECTRUM.spectrum}</h2>
          <ul class="legend inline">
            <li>
              <i class="key dot"></i>
              ${SPECTRUM.keys.harmonics}
            </li>
            <li>
              <i class="key gain"></i>
              ${SPECTRUM.keys.gain}
            </li>
          </ul>
        </figcaption>
        <${Picture}
          name="spectrum"
          title=${SPECTRUM.spectrum}
          model=${spectrumModel}
          paint=${painter(drawSpectrum)}
          label=${SPECTRUM.spectrumPicture}
        />
      </figure>
      <figure class="plot">
        <figcaption>
          <h2>${SPECTRUM.spectrogram}</h2>
          <span class="when width-key">
            ${least}${" "}
            <i></i>
            ${" "}${most}
          </span>
        </figcaption>
        <${Picture}
          name="spectrogram"
          title=${SPECTRUM.spectrogram}
          model=${spectrogramModel}
          paint=${painter(drawSpectrogram)}
          label=${SPECTRUM.spectrogramPicture}
        />
      </figure>
      <figure class="plot">
        <figcaption>
          <h2>
            ${SPECTRUM.tract}${" "}${
              tract.value &&
              html`
                /${tract.value.ipa}/
              `
            }
          </h2>
          <span class="when resonances">
            ${
              tract.value &&
              `${SPECTRUM.formantsTitle}: ${tract.value.formants
                .slice(0, 4)
                .map((row) => Math.round(row.frequency_hz))
                .join(" · ")}`
            }
          </span>
        </figcaption>
        <${Picture}
          name="tract"
          title=${SPECTRUM.tract}
          model=${tractModel}
          paint=${painter(drawTract)}
          label=${SPECTRUM.tractPicture}
        />
      </figure>
    </div>
  `;
}
