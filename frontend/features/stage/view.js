/**
 * The stage: both folds from above in slow motion, between cartilages and muscles; the numbers of the posture; the
 * controls of the motion. Whatever depends only on the posture is painted once, the folds in every frame.
 */
import { computed, html, untracked, useComputed } from "../../core/ui.js";
import { numberText } from "../../core/axis.js";
import { Layer } from "../../core/canvas.js";
import { contactAlong, foldEdges, staticEdges } from "../../core/glottis.js";
import { Picture } from "../../core/picture.js";
import { fieldAt, isVoiced } from "../../core/result.js";
import { palette, smallFont } from "../../core/theme.js";
import { Icon } from "../../core/widgets.js";
import { posture, postureBefore, result } from "../../state/answers.js";
import { musclesShown, orientation, setMusclesShown, setOrientation } from "../../state/look.js";
import {
  holdPhase,
  moving,
  phase,
  RATES,
  readout,
  setMoving,
  setSlowdown,
  setStrobe,
  slowdown,
  strobe,
  STROBES,
} from "../../state/motion.js";
import { now } from "../../state/played-voice.js";
import { muscleOf, musclePaths, schema, values } from "../../state/request.js";
import { anatomyOf, drawBackdrop, drawCartilages, drawMuscles, drawPosteriorGap, strands } from "./anatomy.js";
import { drawFolds, drawGhost, drawMidline, drawMuscleNames, drawScaleBar, drawWords, stageView } from "./paint.js";
import { CLOSURE, STAGE, STROBE } from "./texts.js";

/** `compact`: without the numbers and the legend. */
export function Stage({ compact = false }) {
  return html`
    <section class="stage card" aria-labelledby="stage-title">
      <div class="card-head">
        <h2 id="stage-title">${STAGE.title}</h2>
        <label class="check">
          <input
            type="checkbox"
            checked=${musclesShown.value}
            onChange=${(event) => setMusclesShown(event.target.checked)}
          />
          ${STAGE.muscles}
        </label>
        <div class="segments small" role="group" aria-label=${STAGE.orientation}>
          ${[
            ["anterior_left", STAGE.anteriorLeft],
            ["endoscope", STAGE.endoscope],
          ].map(
            ([key, text]) => html`
              <button
                type="button"
                class="segment"
                aria-pressed=${orientation.value === key}
                onClick=${() => setOrientation(key)}
              >
                <span>${text}</span>
              </button>
            `,
          )}
        </div>
      </div>
      ${
        !compact &&
        html`
          <${PostureLine} />
        `
      }
      <div class="stage-view">
        <${Picture}
          name="stage"
          title=${STAGE.title}
          model=${stageModel}
          paint=${stagePainter()}
          ground=${groundOf}
          label=${STAGE.picture}
        />
        ${
          !compact &&
          html`
            <${Legend} />
            <${Closure} />
          `
        }
        <${FoldsDiffer} />
      </div>
      <${Transport} />
    </section>
  `;
}

/** Everything that depends only on the posture; null before the first. */
const still = computed(() => {
  const answered = posture.value;
  if (!answered) return null;
  const rest = staticEdges(answered.static_shape);
  return {
    colours: palette.value,
    orientation: orientation.value,
    withAnatomy: musclesShown.value,
    anatomy: anatomyOf(rest.lengthMm, answered.posture.glottal_half_angle_rad),
    // Together with the posture, not before it: one picture per movement instead of two.
    activation: untracked(() => Object.fromEntries(musclePaths().map((path) => [muscleOf(path), values.value[path]]))),
    names: Object.fromEntries(musclePaths().map((path) => [muscleOf(path), schema.value.parameters.get(path).short])),
    rest,
  };
});

/** The present stage: moving folds if they vibrate, else folds at rest. */
function stageModel() {
  if (!still.value) return null;
  const { rest } = still.value;
  const folds = now.value
    ? liveFolds(now.value)
    : isVoiced(result.value)
      ? movingFolds(result.value)
      : { edges: rest, contact: rest.u.map(() => 0) };
  return { still: still.value, ...folds };
}

const groundOf = (model) => model.still.colours.panel;

function movingFolds({ fields }) {
  const now = phase.value;
  const along = contactAlong(fields, fieldAt(fields, "contact", now));
  return {
    edges: foldEdges(fields, fieldAt(fields, "w", now)),
    contact: along.map((p) => p / fields.contactRange.max),
  };
}

const HARD_MM = 0.6; // this depth of compression has the warmest glow

/** A played voice at the moment of its strobe. */
function liveFolds(frame) {
  const edges = staticEdges(frame);
  return { edges, contact: edges.inner.map((r) => Math.min(1, Math.max(0, -r) / HARD_MM)) };
}

/** The stage in other colours, for export or print; null before the first posture. */
export function paperStage(colours) {
  const model = stageModel();
  return model && { ...model, still: { ...model.still, colours } };
}

/** Paint a stage model without layers. */
export const paintStage = (context, box, model) => stagePainter()(context, box, model);

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
  return html`
    <p class="closure">${pattern && `${STAGE.atRest} ${CLOSURE[pattern]}`}</p>
  `;
}

function FoldsDiffer() {
  const differ = now.value ? now.value.right : posture.value?.sides;
  return (
    differ &&
    html`
      <p class="folds-differ">${STAGE.foldsDiffer}</p>
    `
  );
}

function Legend() {
  return html`
    <ul class="legend" aria-hidden="true">
      ${Object.entries(STAGE.legend).map(
        ([key, text]) => html`
          <li>
            <i class=${`key ${key}`}></i>
            ${text}
          </li>
        `,
      )}
    </ul>
  `;
}

const DEGREES = 180 / Math.PI;
const ITEMS = [
  { label: STAGE.strain, decimals: 3, read: (p) => p.strain },
  { label: STAGE.angle, decimals: 2, unit: "°", read: (p) => p.glottal_half_angle_rad * DEGREES },
  { label: STAGE.length, decimals: 2, unit: " mm", read: (p) => p.length_m * 1e3 },
];

export function PostureLine() {
  const now = posture.value;
  return html`
    <dl class="posture-line">
      ${ITEMS.map(({ label, decimals, unit = "", read }) => {
        const value = now && read(now.posture);
        const change = now && postureBefore.value ? value - read(postureBefore.value.posture) : 0;
        const seen = Math.abs(change) >= 0.5 * 10 ** -decimals;
        return html`
          <div>
            <dt>${label}</dt>
            <dd>${now ? numberText(value, decimals) + unit : "–"}</dd>
            <dd class="change">${seen ? `Δ ${change > 0 ? "+" : ""}${numberText(change, decimals)}` : ""}</dd>
          </div>
        `;
      })}
    </dl>
  `;
}

export function Transport() {
  const percent = useComputed(() => `${Math.floor(readout.value * 100)}`.padStart(2, "\u2007") + " %");
  const position = useComputed(() => Math.round(readout.value * 1000));
  const words = useComputed(() => STAGE.phaseWords(Math.floor(readout.value * 100)));
  return html`
    <div class="transport">
      <button
        type="button"
        class="icon"
        aria-label=${moving.value ? STAGE.pause : STAGE.play}
        title=${`${moving.value ? STAGE.pause : STAGE.play} (M)`}
        onClick=${() => setMoving(!moving.value)}
      >
        <${Icon} name=${moving.value ? "pause" : "play"} />
      </button>
      <input
        class="scrub"
        type="range"
        min="0"
        max="999"
        step="1"
        value=${position}
        aria-label=${STAGE.phase}
        aria-valuetext=${words}
        onInput=${(event) => holdPhase(event.target.valueAsNumber / 1000)}
      />
      <output class="percent">${percent}</output>
      <label class="pick speed">
        <span class="visually-hidden">${STAGE.speed}</span>
        <select value=${strobe.value ? `strobe ${strobe.value}` : slowdown.value} onChange=${choose}>
          <optgroup label=${STROBE.slow}>
            ${RATES.map(
              (n) => html`
                <option value=${n}>${STAGE.speedOf(n)}</option>
              `,
            )}
          </optgroup>
          <optgroup label=${STROBE.name}>
            ${STROBES.map(
              (hz) => html`
                <option value=${`strobe ${hz}`}>${STROBE.locked(hz)}</option>
              `,
            )}
          </optgroup>
        </select>
      </label>
    </div>
  `;
}

function choose({ target: { value } }) {
  const [, hz] = /^strobe (.*)$/.exec(value) ?? [];
  if (hz) setStrobe(Number(hz));
  else setSlowdown(Number(value));
}
