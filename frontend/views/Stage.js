/** The body: both folds from above, moving in slow motion, between cartilages and muscles. */
import { html } from "../ui.js";
import { muscleOf, musclePaths } from "../state/muscles.js";
import { anatomyOf, drawBackdrop, drawCartilages, drawMuscles, strands } from "../plots/anatomy-draw.js";
import { contactAlong, foldEdges, stageView, staticEdges } from "../plots/glottis.js";
import { drawFolds, drawGhost, drawMidline } from "../plots/glottis-draw.js";
import { drawMuscleNames, drawScaleBar, drawWords } from "../plots/stage-labels.js";
import { palette, smallFont } from "../plots/theme.js";
import { fieldAt, isVoiced } from "../result.js";
import { musclesShown, orientation, setMusclesShown, setOrientation } from "../state/look.js";
import { phase } from "../state/motion.js";
import { posture, result } from "../state/outcome.js";
import { schema, values } from "../state/request.js";
import { CLOSURE, STAGE } from "../texts.js";
import { Picture } from "./Picture.js";
import { PostureLine } from "./PostureLine.js";
import { Transport } from "./Transport.js";

/** `compact`: without the numbers and the legend. */
export function Stage({ compact = false }) {
  return html`
    <section class="stage card" aria-labelledby="stage-title">
      <div class="card-head">
        <h2 id="stage-title">${STAGE.title}</h2>
        <label class="check"><input type="checkbox" checked=${musclesShown.value} onChange=${(event) => setMusclesShown(event.target.checked)} />${STAGE.muscles}</label>
        <div class="segments small" role="group" aria-label=${STAGE.orientation}>
          ${[["anterior_left", STAGE.anteriorLeft], ["endoscope", STAGE.endoscope]].map(
            ([key, text]) => html`<button type="button" class="segment" aria-pressed=${orientation.value === key} onClick=${() => setOrientation(key)}><span>${text}</span></button>`,
          )}
        </div>
      </div>
      ${!compact && html`<${PostureLine} />`}
      <div class="stage-view">
        <${Picture} name="stage" model=${stageModel} paint=${paintStage} label=${STAGE.picture} />
        ${!compact && html`<${Legend} /><${Closure} />`}
      </div>
      <${Transport} />
    </section>
  `;
}

/** What the stage shows now; null before the first posture. */
export function stageModel() {
  const answered = posture.value;
  if (!answered) return null;
  const shown = result.value;
  const rest = staticEdges(answered.static_shape);
  const vibrating = isVoiced(shown);
  return {
    colours: palette.value,
    orientation: orientation.value,
    withAnatomy: musclesShown.value,
    anatomy: anatomyOf(rest.lengthMm, answered.posture.glottal_half_angle_rad),
    activation: Object.fromEntries(musclePaths().map((path) => [muscleOf(path), values.value[path]])),
    names: Object.fromEntries(musclePaths().map((path) => [muscleOf(path), schema.value.parameters.get(path).short])),
    rest,
    ...(vibrating ? movingFolds(shown) : { edges: rest, contact: rest.u.map(() => 0) }),
  };
}

function movingFolds({ fields }) {
  const now = phase.value;
  const along = contactAlong(fields, fieldAt(fields, "contact", now));
  return { edges: foldEdges(fields, fieldAt(fields, "w", now)), contact: along.map((p) => Math.min(1, p / fields.contactMax)) };
}

function paintStage(context, box, { colours, orientation: turned, withAnatomy, anatomy, activation, names, rest, edges, contact }) {
  const view = stageView(box.width, box.height, turned, withAnatomy);
  drawBackdrop(context, view, anatomy, colours);
  drawFolds(context, view, edges, contact, colours);
  drawGhost(context, view, rest, colours);
  drawMidline(context, view, edges, colours);
  if (withAnatomy) {
    drawCartilages(context, view, anatomy, colours);
    drawMuscles(context, view, anatomy, activation, colours);
    drawMuscleNames(context, view, strands(anatomy), names, colours, smallFont(700));
  }
  drawWords(context, view, box, STAGE, turned, colours, smallFont());
  drawScaleBar(context, view, box, colours, smallFont());
}

function Closure() {
  const pattern = posture.value?.static_shape.closure_pattern;
  return html`<p class="closure">${pattern && `${STAGE.atRest} ${CLOSURE[pattern]}`}</p>`;
}

function Legend() {
  return html`
    <ul class="legend" aria-hidden="true">
      ${Object.entries(STAGE.legend).map(([key, text]) => html`<li><i class=${`key ${key}`}></i>${text}</li>`)}
    </ul>
  `;
}
