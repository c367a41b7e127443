/** Undo, redo and the buttons to hold A and B; the list of the voices of this visit. */
import { html } from "../../core/ui.js";
import { numberText } from "../../core/axis.js";
import { presetOf } from "../../core/parameters.js";
import { STATES } from "../../core/texts.js";
import { Icon } from "../../core/widgets.js";
import { narrow, setPanel } from "../../state/look.js";
import { defaultsOf, schema, valuesOf } from "../../state/request.js";
import { announce, showNotice } from "../../state/session.js";
import { held, hold, release } from "../compare/state.js";
import { COMPARE } from "../compare/texts.js";
import { changeSummary, differingSettings } from "../controls/settings-text.js";
import { at, canRedo, canUndo, entries, goTo, redo, undo } from "./history.js";
import { HISTORY } from "./texts.js";

const NOTICE_S = 3; // on a phone it covers controls

/** Hold or release a side, announce it, and show the comparison. */
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
      <button
        type="button"
        class="icon"
        aria-label=${HISTORY.undo}
        title=${`${HISTORY.undo} (Ctrl Z)`}
        disabled=${!canUndo.value}
        onClick=${undo}
      >
        <${Icon} name="undo" />
      </button>
      <button
        type="button"
        class="icon"
        aria-label=${HISTORY.redo}
        title=${`${HISTORY.redo} (Ctrl Shift Z)`}
        disabled=${!canRedo.value}
        onClick=${redo}
      >
        <${Icon} name="redo" />
      </button>
      ${["a", "b"].map(
        (side) => html`
          <button
            key=${side}
            type="button"
            class=${`quiet hold mark-${side}`}
            aria-pressed=${held.value[side] !== null}
            title=${COMPARE.holdHelp[side]}
            onClick=${() => toggleHold(side)}
          >
            ${COMPARE.hold[side]}
          </button>
        `,
      )}
    </div>
  `;
}

export function HistoryList() {
  const known = entries.value;
  return html`
    <section class="history" aria-labelledby="history-title">
      <h2 id="history-title">${HISTORY.title}</h2>
      ${
        known.length < 2 &&
        html`
          <p class="caution">${HISTORY.empty}</p>
        `
      }
      <ol reversed>
        ${known
          .map(
            (entry, k) => html`
              <${Entry} key=${k} place=${k} entry=${entry} before=${known[k - 1]?.patch} />
            `,
          )
          .reverse()}
      </ol>
    </section>
  `;
}

function Entry({ place, entry, before }) {
  const values = valuesOf(entry.patch);
  const chosen = presetOf(schema.value, entry.patch, defaultsOf(entry.patch));
  const changed = before ? differingSettings(schema.value, before, entry.patch) : [];
  const label = changeSummary(changed, values, chosen?.label, HISTORY);
  return html`
    <li>
      <button
        type="button"
        class="plain"
        aria-current=${place === at.value ? "true" : undefined}
        onClick=${() => goTo(place)}
      >
        <b>${label}</b>
        ${" "}
        <span>${entry.pitch ? `${numberText(entry.pitch)} Hz` : STATES[entry.state]}</span>
      </button>
    </li>
  `;
}
