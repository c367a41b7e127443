/** The folds over time: kymogram at a level, glottovibrogram; both under the shared cursor. */
import { computed, html } from "../ui.js";
import { niceCeil } from "../plots/axis.js";
import { drawKymogram, drawVibrogram, foldsField } from "../plots/kymogram-draw.js";
import { CYCLES, LEVELS, kymogramOf, vibrogramOf } from "../plots/kymogram.js";
import { palette, rootPx, smallFont } from "../plots/theme.js";
import { isVoiced } from "../result.js";
import { kymogramLevel, setKymogramLevel } from "../state/deeper.js";
import { rested } from "../state/rested.js";
import { FOLDS } from "../texts.js";
import { CycleStrip } from "./CycleStrip.js";
import { Picture } from "./Picture.js";
import { PhaseCursor } from "./PhaseCursor.js";

const LEAST_MM = 0.5;

const voiced = computed(() => (isVoiced(rested.value) ? rested.value : null));
const width = computed(() => voiced.value && vibrogramOf(voiced.value.fields));
const xLabel = computed(() => (voiced.value?.cycle.complete ? FOLDS.cycles : FOLDS.free));

function kymogramModel() {
  if (!voiced.value) return null;
  const lines = kymogramOf(voiced.value.fields, kymogramLevel.value);
  return { lines, limit: niceCeil(Math.max(LEAST_MM, ...lines.superior, ...lines.inferior)), colours: palette.value, xLabel: xLabel.value };
}

function vibrogramModel() {
  if (!voiced.value) return null;
  const { phases, nx } = voiced.value.fields;
  return { width: width.value, phases, nx, limit: niceCeil(Math.max(LEAST_MM, ...width.value)), colours: palette.value, xLabel: xLabel.value };
}

const painter = (draw) => (context, box, model) => draw(context, box, model, rootPx(), smallFont(), FOLDS);
const fieldOf = (box) => foldsField(box, rootPx());

export function FoldsPanel() {
  const limit = voiced.value && vibrogramModel().limit;
  return html`
    <div class="stacked folds-panel">
      <figure class="plot">
        <figcaption>
          <h2>${FOLDS.kymogram}</h2>
          <div class="segments small" role="group" aria-label=${`${FOLDS.level} (${FOLDS.levelHelp})`}>
            ${LEVELS.map((level) => html`<button key=${level} type="button" class="segment" aria-pressed=${kymogramLevel.value === level} onClick=${() => setKymogramLevel(level)}><span>${Math.round(100 * level)} %</span></button>`)}
          </div>
        </figcaption>
        <div class="under-cursor">
          <${Picture} name="kymogram" title=${FOLDS.kymogram} model=${kymogramModel} paint=${painter(drawKymogram)} label=${FOLDS.kymogramPicture} />
          <${PhaseCursor} name="kymogram-cursor" fieldOf=${fieldOf} cycles=${CYCLES} />
        </div>
      </figure>
      <figure class="plot">
        <figcaption><h2>${FOLDS.vibrogram}</h2><span class="when width-key">${limit && html`0 <i></i> ${limit} ${FOLDS.width}`}</span></figcaption>
        <div class="under-cursor">
          <${Picture} name="vibrogram" title=${FOLDS.vibrogram} model=${vibrogramModel} paint=${painter(drawVibrogram)} label=${FOLDS.vibrogramPicture} />
          <${PhaseCursor} name="vibrogram-cursor" fieldOf=${fieldOf} cycles=${CYCLES} />
        </div>
      </figure>
      <${CycleStrip} />
      <p class="caution">${voiced.value ? FOLDS.drag : FOLDS.nothing}</p>
    </div>
  `;
}
