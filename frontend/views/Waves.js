/** The consequence: five waves on one time axis, one cursor, one highlighted cycle. */
import { computed, html, useComputed } from "../ui.js";
import { Icon } from "../controls/Icon.js";
import { numberText, steadyLimits } from "../plots/axis.js";
import { palette, rootPx, smallFont } from "../plots/theme.js";
import { drawWaves, stackLayout } from "../plots/wave-draw.js";
import { ROWS, valueAt, waveRows } from "../plots/waves.js";
import { openDialog } from "../state/look.js";
import { readout } from "../state/motion.js";
import { result } from "../state/outcome.js";
import { WAVES } from "../texts.js";
import { Cursor } from "./Cursor.js";
import { Picture } from "./Picture.js";

const rows = computed(() => (result.value ? waveRows(result.value) : null));

// Limits follow the data with some memory: see steadyLimits.
let limitsBefore = [];
const limits = computed(() => {
  if (!rows.value) return [];
  limitsBefore = rows.value.rows.map((row, k) => steadyLimits(limitsBefore[k], row.range, row));
  return limitsBefore;
});

export function Waves() {
  return html`
    <div class="waves">
      <div class="wave-stack">
        <${Picture} name="waves" title=${WAVES.stack} label=${WAVES.picture} paint=${paintWaves} model=${() => rows.value && { shown: result.value, stack: rows.value, limits: limits.value, colours: palette.value }} />
        <${Cursor} rows=${rows} />
        <div class="wave-names" style=${{ "--rows": ROWS.length }}>
          ${ROWS.map((row, k) => html`<div class="wave-name" key=${row.key}><span>${WAVES[row.key]}</span> <${AtCursor} row=${row} index=${k} /></div>`)}
        </div>
      </div>
      <div class="wave-foot">
        <span>${result.value?.cycle.complete === false ? WAVES.timeFree : WAVES.time}</span>
        <button type="button" class="quiet" aria-label=${WAVES.zoom} title=${WAVES.zoomHelp} onClick=${() => openDialog("detail")}><${Icon} name="zoom" /><span>${WAVES.zoom}</span></button>
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
  return html`<span class="at-cursor">${text}</span>`;
}

function paintWaves(context, box, { shown, stack, limits: ranges, colours }) {
  const layout = stackLayout(box.width, box.height, stack.rows.length, stack.window, rootPx());
  drawWaves(context, layout, shown, stack, ranges, colours, smallFont());
}
