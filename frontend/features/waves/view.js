/** Five waves on one time axis, with one cursor and one highlighted cycle. */
import { computed, effect, html, signal, useComputed, useEffect, useRef } from "../../core/ui.js";
import { numberText, steadyLimits } from "../../core/axis.js";
import { openDialog } from "../../core/dialog.js";
import { Disposal } from "../../core/dispose.js";
import { Picture } from "../../core/picture.js";
import { phaseOf } from "../../core/result.js";
import { palette, rootPx, smallFont } from "../../core/theme.js";
import { Icon } from "../../core/widgets.js";
import { result } from "../../state/answers.js";
import { holdPhase, phase, pointAt, readout, stopPointing } from "../../state/motion.js";
import { drawWaves, ROWS, stackLayout, valueAt, waveRows } from "./stack.js";
import { WAVES } from "./texts.js";

const rows = computed(() => (result.value ? waveRows(result.value) : null));

// Limits follow the data with a memory: see steadyLimits.
let limitsBefore = [];
const limits = computed(() => {
  if (!rows.value) return [];
  limitsBefore = rows.value.rows.map((row, k) => steadyLimits(limitsBefore[k], row.range, row));
  return limitsBefore;
});

const model = () =>
  rows.value && { shown: result.value, stack: rows.value, limits: limits.value, colours: palette.value };

export function Waves() {
  return html`
    <div class="waves">
      <div class="wave-stack">
        <${Picture} name="waves" title=${WAVES.stack} label=${WAVES.picture} paint=${paintWaves} model=${model} />
        <${Cursor} rows=${rows} />
        <div class="wave-names" style=${{ "--rows": ROWS.length }}>
          ${ROWS.map(
            (row, k) => html`
              <div class="wave-name" key=${row.key}>
                <span>${WAVES[row.key]}</span>
                ${" "}
                <${AtCursor} row=${row} index=${k} />
              </div>
            `,
          )}
        </div>
      </div>
      <div class="wave-foot">
        <span>${result.value?.cycle.complete === false ? WAVES.timeFree : WAVES.time}</span>
        <button
          type="button"
          class="quiet"
          aria-label=${WAVES.zoom}
          title=${WAVES.zoomHelp}
          onClick=${() => openDialog("detail")}
        >
          <${Icon} name="zoom" />
          <span>${WAVES.zoom}</span>
        </button>
      </div>
    </div>
  `;
}

function AtCursor({ row, index }) {
  const text = useComputed(() => {
    const shown = result.value;
    if (!shown || !rows.value) return "";
    const value = valueAt(shown, rows.value, index, shown.cycle.startS + readout.value * shown.cycle.periodS);
    const decimals = row.unit === "kPa" ? 2 : row.unit === "mm²" ? 1 : 0;
    return value === null ? "" : `${numberText(value, decimals)} ${row.unit}`;
  });
  return html`
    <span class="at-cursor">${text}</span>
  `;
}

function paintWaves(context, box, { shown, stack, limits: ranges, colours }) {
  const layout = stackLayout(box.width, box.height, stack.rows.length, stack.window, rootPx());
  drawWaves(context, layout, shown, stack, ranges, colours, smallFont());
}

/** The shared cursor: one line in the highlighted cycle, and faint ones at the same phase of the others. */
export function Cursor({ rows }) {
  const field = useRef(null);
  const lines = useRef(null);
  useEffect(() => follow(field.current, lines.current, rows), []);
  return html`
    <div ref=${field} class="cursor-field" data-picture="cursor" ...${pointing(rows)}>
      <div class="cursor-clip"><div ref=${lines} class="cursor-lines"></div></div>
    </div>
  `;
}

const layoutIn = (element, rows) =>
  stackLayout(element.clientWidth, element.clientHeight, rows.peek().rows.length, rows.peek().window, rootPx());

function follow(field, lines, rows) {
  const disposal = new Disposal();
  const resized = signal(0);
  const observer = new ResizeObserver(() => resized.value++);
  observer.observe(field);
  disposal.add(() => observer.disconnect());
  let period = 0;
  let start = 0;
  const place = () => (lines.style.transform = `translateX(${start + phase.peek() * period}px)`);
  disposal.add(
    effect(() => {
      void resized.value;
      if (!rows.value || field.clientWidth === 0) return;
      const { cycle } = result.peek();
      const layout = layoutIn(field, rows);
      const clip = lines.parentElement.style;
      clip.left = `${layout.left}px`;
      clip.width = `${layout.right - layout.left + 1}px`;
      clip.bottom = `${layout.foot}px`;
      start = layout.x(cycle.startS) - layout.left;
      period = layout.x(cycle.startS + cycle.periodS) - layout.x(cycle.startS);
      const count = cycle.complete ? Math.min(40, Math.ceil(start / period) + 1) : 0;
      const others = Array.from({ length: count }, (_, k) => {
        const line = document.createElement("i");
        line.style.left = `${-(k + 1) * period}px`;
        return line;
      });
      lines.replaceChildren(document.createElement("b"), ...others);
      place();
    }),
  );
  disposal.add(
    effect(() => {
      void phase.value;
      place();
    }),
  );
  return () => disposal.dispose();
}

/** A mouse over the waves shows an instant; a press, pen or finger holds it. */
function pointing(rows) {
  const look = (event) => {
    if (!rows.peek()) return;
    const field = event.currentTarget;
    const layout = layoutIn(field, rows);
    const x = event.clientX - field.getBoundingClientRect().left;
    if (x < layout.left || x > layout.right) return stopPointing();
    const at = phaseOf(result.peek(), layout.time(x));
    if (event.buttons !== 0) holdPhase(at);
    else if (event.pointerType === "mouse") pointAt(at);
  };
  return { onPointerDown: look, onPointerMove: look, onPointerLeave: stopPointing };
}
