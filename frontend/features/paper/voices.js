/** One voice of the paper: waves, extreme shapes, the cycle matrix. */
import { computed, html } from "../../core/ui.js";
import { niceCeil, numberText, steadyLimits } from "../../core/axis.js";
import { colourGradient } from "../../core/colours.js";
import { foldEdges, staticEdges } from "../../core/glottis.js";
import { Picture } from "../../core/picture.js";
import { extent, fieldAt } from "../../core/result.js";
import { palette, rootPx, smallFont, theme } from "../../core/theme.js";
import { narrow } from "../../state/look.js";
import { drawShapes, extremeShapes } from "../folds/shapes.js";
import { SHAPES } from "../folds/texts.js";
import { drawCycleMatrix, matrixLayout } from "./cycle-matrix.js";
import { voiceOf } from "./figures.js";
import { Claims, FigureTools, openCase } from "./parts.js";
import { figures, paper, setVoiceShown, voiceShown } from "./state.js";
import { PAPER } from "./texts.js";
import { contactScale, pressureScale } from "../surface/view.js";
import { drawWaves, stackLayout, waveRows } from "../waves/stack.js";
import { WAVES } from "../waves/texts.js";

const KEYS = Object.keys(PAPER.voices);
const SHOWN_WAVES = ["area", "flow", "pressure"];
const PHASES = Array.from({ length: 8 }, (_, k) => k / 8);

const voices = computed(() => Object.fromEntries(KEYS.map((key) => [key, voiceOf(figures.value[key])])));
const shown = computed(() => voices.value[voiceShown.value]);

/** Limits that all three voices share, so that they can be compared. */
const common = computed(() => {
  const all = Object.values(voices.value);
  const widest = (name) => ({
    min: Math.min(...all.map(({ fields }) => fields[name].min)),
    max: Math.max(...all.map(({ fields }) => fields[name].max)),
  });
  const ranges = { aeroRange: widest("aeroRange"), contactRange: widest("contactRange") };
  const outlines = all.map(outlinesOf);
  const r = extent(
    outlines.flatMap(({ open, closed, rest }) => [open, closed, rest].flatMap((e) => [...e.superior, ...e.inferior])),
  );
  const stacks = all.map(stackOf);
  const waves = SHOWN_WAVES.map((key, k) =>
    steadyLimits(
      undefined,
      {
        min: Math.min(...stacks.map((s) => s.rows[k].range.min)),
        max: Math.max(...stacks.map((s) => s.rows[k].range.max)),
      },
      stacks[0].rows[k],
    ),
  );
  const inner = all.flatMap(({ fields }) => PHASES.flatMap((p) => foldEdges(fields, fieldAt(fields, "w", p)).superior));
  return {
    scales: { aero: pressureScale(ranges), contact: contactScale(ranges) },
    r: steadyLimits(undefined, r, { least: 1 }),
    waves,
    reachMm: niceCeil(Math.max(...inner)),
  };
});

function stackOf(voice) {
  const { window, rows } = waveRows(voice);
  return { window, rows: SHOWN_WAVES.map((key) => rows.find((row) => row.key === key)) };
}

const outlinesOf = (voice) => ({ ...extremeShapes(voice.fields), rest: staticEdges(voice.staticShape) });

const wavesModel = () => ({
  voice: shown.value,
  stack: stackOf(shown.value),
  limits: common.value.waves,
  colours: palette.value,
});

const matrixModel = () => ({
  fields: shown.value.fields,
  phases: PHASES,
  scales: common.value.scales,
  reachMm: common.value.reachMm,
  colours: palette.value,
});

export function PaperVoice() {
  const figure = figures.value[voiceShown.value];
  const claims = paper.value.claims.map(({ key }) => key).filter((key) => figure.claims.includes(key));
  const { scales, reachMm } = common.value;
  return html`
    <div class="paper-row">
      <div class="segments small" role="group" aria-label=${PAPER.voicesLabel}>
        ${KEYS.map(
          (key) => html`
            <button
              type="button"
              key=${key}
              class="segment"
              aria-pressed=${voiceShown.value === key}
              onClick=${() => setVoiceShown(key)}
            >
              <span>${PAPER.voices[key]}</span>
            </button>
          `,
        )}
      </div>
      <button type="button" class="button" onClick=${() => openCase(figure, [])}>${PAPER.open}</button>
      <${FigureTools} figure=${figure} />
    </div>
    <div class="voice-left">
      <figure class="paper-figure">
        <figcaption><h3>${PAPER.waves}</h3></figcaption>
        <div class="paper-picture wave-stack">
          <${Picture} name="paper-waves" label=${WAVES.picture} paint=${paintWaves} model=${wavesModel} />
          <div class="wave-names" style=${{ "--rows": SHOWN_WAVES.length }}>
            ${stackOf(shown.value).rows.map(
              ({ key, unit }) => html`
                <div class="wave-name" key=${key}>
                  <span>${WAVES[key]}</span>
                  <span class="at-cursor">${unit}</span>
                </div>
              `,
            )}
          </div>
        </div>
        <p class="wave-foot"><span>${WAVES.time}</span></p>
      </figure>
      <figure class="paper-figure">
        <figcaption><h3>${PAPER.shapes}</h3></figcaption>
        <div class="paper-picture">
          <${Picture}
            name="paper-shapes"
            label=${SHAPES.picture}
            paint=${paintShapes}
            model=${() => ({ ...outlinesOf(shown.value), r: common.value.r, colours: palette.value })}
          />
        </div>
        <ul class="legend inline">
          ${["open", "closed", "static"].map(
            (key) => html`
              <li key=${key}>
                <i class=${`key shape-${key}`}></i>
                ${SHAPES[key]}
              </li>
            `,
          )}
        </ul>
      </figure>
    </div>
    <figure class="paper-figure voice-matrix">
      <figcaption><h3>${PAPER.matrix}</h3></figcaption>
      <div class="paper-picture">
        <${Picture} name="paper-matrix" label=${PAPER.matrixPicture} paint=${paintMatrix} model=${matrixModel} />
      </div>
      <div class="matrix-bars">
        <p>${PAPER.reach(reachMm)}</p>
        <${Bar} name=${PAPER.columns.aero} scale=${scales.aero} />
        <${Bar} name=${PAPER.columns.contact} scale=${scales.contact} />
      </div>
    </figure>
    <div class="voice-claims"><${Claims} keys=${claims} /></div>
  `;
}

function Bar({ name, scale }) {
  const gradient = colourGradient(scale, theme.value).replace("to top", "to right");
  return html`
    <div class="bar" role="img" aria-label=${`${name}, ${scale.low} to ${scale.limit} Pa`}>
      <i style=${{ background: gradient }}></i>
      <span>${numberText(scale.low)}</span>
      <span>${numberText(scale.limit)}${" "}Pa</span>
    </div>
  `;
}

function paintWaves(context, box, { voice, stack, limits, colours }) {
  drawWaves(
    context,
    stackLayout(box.width, box.height, stack.rows.length, stack.window, rootPx()),
    voice,
    stack,
    limits,
    colours,
    smallFont(),
  );
}

function paintShapes(context, size, { open, closed, rest, r, colours }) {
  const unit = rootPx();
  const box = { left: 3.1 * unit, right: size.width - 0.5 * unit, top: 0.4 * unit, bottom: size.height - 1.35 * unit };
  const shapes = [
    { edges: rest, colour: colours.inkSoft },
    { edges: open, colour: colours.mostOpen },
    { edges: closed, colour: colours.mostClosed },
  ];
  drawShapes(context, box, shapes, { x: [0, 20], r }, colours, smallFont(), SHAPES);
}

function paintMatrix(context, box, model) {
  drawCycleMatrix(
    context,
    matrixLayout(box.width, box.height, model.phases.length, rootPx()),
    model,
    model.colours,
    smallFont(),
    narrow.peek() ? PAPER.narrowColumns : PAPER.columns,
  );
}
