/** Undo, redo, hold A and B: what one does between voices. */
import { html } from "../ui.js";
import { held, hold, release } from "../state/compare.js";
import { canRedo, canUndo, redo, undo } from "../state/history.js";
import { narrow, setPanel } from "../state/look.js";
import { announce, showNotice } from "../state/session.js";
import { COMPARE, HISTORY } from "../texts.js";
import { Icon } from "./Icon.js";

const NOTICE_S = 3; // on a phone it lies over what one would move next

/** Hold or release a side, say so, and show the comparison. */
export function toggleHold(side) {
  if (side === "b" && held.peek().b) return release("b");
  if (!hold(side)) return;
  announce(COMPARE.held[side]);
  if (narrow.peek()) showNotice(COMPARE.held[side], NOTICE_S);
  setPanel("compare");
}

export function HistoryTools() {
  return html`
    <div class="history-tools" role="group" aria-label=${HISTORY.title}>
      <button type="button" class="icon" aria-label=${HISTORY.undo} title=${`${HISTORY.undo} (Ctrl Z)`} disabled=${!canUndo.value} onClick=${undo}><${Icon} name="undo" /></button>
      <button type="button" class="icon" aria-label=${HISTORY.redo} title=${`${HISTORY.redo} (Ctrl Shift Z)`} disabled=${!canRedo.value} onClick=${redo}><${Icon} name="redo" /></button>
      ${["a", "b"].map((side) => html`<button key=${side} type="button" class=${`quiet hold mark-${side}`} aria-pressed=${held.value[side] !== null} title=${COMPARE.holdHelp[side]} onClick=${() => toggleHold(side)}>${COMPARE.hold[side]}</button>`)}
    </div>
  `;
}
