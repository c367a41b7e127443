/**
 * The body: both folds from above, moving in slow motion, between cartilages and muscles. What the posture decides is
 * painted once, the folds in every frame.
 */
import { computed, html } from "../ui.js";
import { muscleOf, musclePaths } from "../state/muscles.js";
import { anatomyOf, drawBackdrop, drawCartilages, drawMuscles, drawPosteriorGap, strands } from "../plots/anatomy-draw.js";
import { Layer } from "../plots/canvas.js";
import { contactAlong, foldEdges, stageView, staticEdges } from "../plots/glottis.js";
import { drawFolds, drawGhost, drawMidline } from "../plots/glottis-draw.js";
import { drawMuscleNames, drawScaleBar, drawWords } from "../plots/stage-labels.js";
import { palette, smallFont } from "../plots/theme.js";
import { fieldAt, isVoiced } from "../result.js";
import { musclesShown, orientation, setMusclesShown, setOrientation } from "../state/look.js";
import { phase } from "../state/motion.js";
import { posture, result } from "../state/outcome.js";
import { now } from "../state/play.js";
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
        <${Picture} name="stage" model=${stageModel} paint=${stagePainter()} ground=${groundOf} label=${STAGE.picture} />
        ${!compact && html`<${Legend} /><${Closure} />`}
      </div>
      <${Transport} />
    </section>
  `;
}

/** What the posture decides; null before the first. */
const still = computed(() => {
  const answered = posture.value;
  if (!answered) return null;
  const rest = staticEdges(answered.static_shape);
  return {
    colours: palette.value,
    orientation: orientation.value,
    withAnatomy: musclesShown.value,
    anatomy: anatomyOf(rest.lengthMm, answered.posture.glottal_half_angle_rad),
    activation: Object.fromEntries(musclePaths().map((path) => [muscleOf(path), values.value[path]])),
    names: Object.fromEntries(musclePaths().map((path) => [muscleOf(path), schema.value.parameters.get(path).short])),
    rest,
  };
});

/** The stage now: folds moving where they vibrate, at rest where they do not. */
function stageModel() {
  if (!still.value) return null;
  const { rest } = still.value;
  const folds = now.value ? liveFolds(now.value) : isVoiced(result.value) ? movingFolds(result.value) : { edges: rest, contact: rest.u.map(() => 0) };
  return { still: still.value, ...folds };
}

const groundOf = (model) => model.still.colours.panel;

function movingFolds({ fields }) {
  const now = phase.value;
  const along = contactAlong(fields, fieldAt(fields, "contact", now));
  return { edges: foldEdges(fields, fieldAt(fields, "w", now)), contact: along.map((p) => p / fields.contactRange.max) };
}

const HARD_MM = 0.6; // pressed into the other fold by this much: the warmest glow

/** A played voice at the moment its strobe shows. */
function liveFolds(frame) {
  const edges = staticEdges(frame);
  return { edges, contact: edges.inner.map((r) => Math.min(1, Math.max(0, -r) / HARD_MM)) };
}

function stagePainter() {
  const behind = new Layer();
  const before = new Layer();
  return (context, box, model) => {
    behind.draw(context, box, model.still, paintBehind);
    drawFolds(context, viewOf(box, model.still), model.edges, model.contact, model.still.colours);
    before.draw(context, box, model.still, paintBefore);
  };
}

const viewOf = (box, model) => stageView(box.width, box.height, model.orientation, model.withAnatomy);

function paintBehind(context, box, model) {
  const view = viewOf(box, model);
  drawBackdrop(context, view, model.anatomy, model.colours);
  drawPosteriorGap(context, view, model.anatomy, model.colours);
}

function paintBefore(context, box, model) {
  const { anatomy, colours, rest } = model;
  const view = viewOf(box, model);
  drawGhost(context, view, rest, colours);
  drawMidline(context, view, rest, colours);
  if (model.withAnatomy) {
    drawCartilages(context, view, anatomy, colours);
    drawMuscles(context, view, anatomy, model.activation, colours);
    drawMuscleNames(context, view, strands(anatomy), model.names, colours, smallFont(700));
  }
  drawWords(context, view, box, STAGE, model.orientation, colours, smallFont());
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
