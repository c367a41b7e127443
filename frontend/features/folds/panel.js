/** The folds over time: kymogram at one level, glottovibrogram and cycle strip under the shared cursor. */
import { computed, effect, html, readonly, signal, useEffect, useRef } from "../../core/ui.js";
import { niceCeil } from "../../core/axis.js";
import { Disposal } from "../../core/dispose.js";
import { Picture } from "../../core/picture.js";
import { isVoiced } from "../../core/result.js";
import { palette, rootPx, smallFont } from "../../core/theme.js";
import { holdPhase, phase, pointAt, stopPointing } from "../../state/motion.js";
import { settled } from "../../state/settled.js";
import { CycleStrip } from "./cycle-strip.js";
import { CYCLES, drawKymogram, drawVibrogram, foldsField, kymogramOf, LEVELS, vibrogramOf } from "./kymogram.js";
import { FOLDS } from "./texts.js";

const _level = signal(0.5);

/** Level of the kymogram as a fraction of the length, anterior 0. */
export const kymogramLevel = readonly(_level);

export function setKymogramLevel(level) {
  _level.value = level;
}

const LEAST_MM = 0.5;

const voiced = computed(() => (isVoiced(settled.value) ? settled.value : null));
const width = computed(() => voiced.value && vibrogramOf(voiced.value.fields));
const xLabel = computed(() => (voiced.value?.cycle.complete ? FOLDS.cycles : FOLDS.free));

function kymogramModel() {
  if (!voiced.value) return null;
  const lines = kymogramOf(voiced.value.fields, kymogramLevel.value);
  return {
    lines,
    limit: niceCeil(Math.max(LEAST_MM, ...lines.superior, ...lines.inferior)),
    colours: palette.value,
    xLabel: xLabel.value,
  };
}

function vibrogramModel() {
  if (!voiced.value) return null;
  const { phases, nx } = voiced.value.fields;
  return {
    width: width.value,
    phases,
    nx,
    limit: niceCeil(Math.max(LEAST_MM, ...width.value)),
    colours: palette.value,
    xLabel: xLabel.value,
  };
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
            ${LEVELS.map(
              (level) => html`
                <button
                  key=${level}
                  type="button"
                  class="segment"
                  aria-pressed=${kymogramLevel.value === level}
                  onClick=${() => setKymogramLevel(level)}
                >
                  <span>${Math.round(100 * level)}${" "}%</span>
                </button>
              `,
            )}
          </div>
        </figcaption>
        <div class="under-cursor">
          <${Picture}
            name="kymogram"
            title=${FOLDS.kymogram}
            model=${kymogramModel}
            paint=${painter(drawKymogram)}
            label=${FOLDS.kymogramPicture}
          />
          <${PhaseCursor} name="kymogram-cursor" fieldOf=${fieldOf} cycles=${CYCLES} />
        </div>
      </figure>
      <figure class="plot">
        <figcaption>
          <h2>${FOLDS.vibrogram}</h2>
          <span class="when width-key">
            ${
              limit &&
              html`
                0${" "}
                <i></i>
                ${" "}${limit}${" "}${FOLDS.width}
              `
            }
          </span>
        </figcaption>
        <div class="under-cursor">
          <${Picture}
            name="vibrogram"
            title=${FOLDS.vibrogram}
            model=${vibrogramModel}
            paint=${painter(drawVibrogram)}
            label=${FOLDS.vibrogramPicture}
          />
          <${PhaseCursor} name="vibrogram-cursor" fieldOf=${fieldOf} cycles=${CYCLES} />
        </div>
      </figure>
      <${CycleStrip} />
      <p class="caution">${voiced.value ? FOLDS.drag : FOLDS.nothing}</p>
    </div>
  `;
}

/** `fieldOf(box)` → {left, right, top, bottom} in px; `cycles` across it. */
export function PhaseCursor({ name, fieldOf, cycles }) {
  const place = useRef(null);
  useEffect(() => follow(place.current, fieldOf, cycles), []);
  const look = (event) => {
    const element = place.current;
    const field = fieldOf({ width: element.clientWidth, height: element.clientHeight });
    const x = event.clientX - element.getBoundingClientRect().left;
    if (x < field.left || x > field.right) return stopPointing();
    const at = ((x - field.left) / (field.right - field.left)) * cycles;
    if (event.buttons !== 0) holdPhase(at);
    else if (event.pointerType === "mouse") pointAt(at);
  };
  return html`
    <div
      ref=${place}
      class="phase-cursor"
      data-picture=${name}
      onPointerDown=${look}
      onPointerMove=${look}
      onPointerLeave=${stopPointing}
    >
      ${Array.from(
        { length: cycles },
        (_, k) => html`
          <i key=${k}></i>
        `,
      )}
    </div>
  `;
}

function follow(element, fieldOf, cycles) {
  const disposal = new Disposal();
  let field = null;
  const measure = () => {
    field = fieldOf({ width: element.clientWidth, height: element.clientHeight });
    for (const line of element.children)
      Object.assign(line.style, { top: `${field.top}px`, height: `${field.bottom - field.top}px` });
    move();
  };
  const move = () => {
    const cycle = (field.right - field.left) / cycles;
    [...element.children].forEach(
      (line, k) => (line.style.transform = `translateX(${field.left + (k + phase.peek()) * cycle}px)`),
    );
  };
  const observer = new ResizeObserver(measure);
  observer.observe(element);
  disposal.add(() => observer.disconnect());
  measure();
  disposal.add(
    effect(() => {
      void phase.value;
      move();
    }),
  );
  return () => disposal.dispose();
}
