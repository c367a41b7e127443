/** Slow motion: play, the phase of the cycle, and the rate it is shown at. */
import { html, useComputed } from "../ui.js";
import { Icon } from "../controls/Icon.js";
import { RATES, STROBES, holdPhase, moving, readout, setMoving, setSlowdown, setStrobe, slowdown, strobe } from "../state/motion.js";
import { STAGE, STROBE } from "../texts.js";

export function Transport() {
  const percent = useComputed(() => `${Math.floor(readout.value * 100)}`.padStart(2, "\u2007") + " %");
  const position = useComputed(() => Math.round(readout.value * 1000));
  const words = useComputed(() => STAGE.phaseWords(Math.floor(readout.value * 100)));
  return html`
    <div class="transport">
      <button type="button" class="icon" aria-label=${moving.value ? STAGE.pause : STAGE.play} title=${`${moving.value ? STAGE.pause : STAGE.play} (M)`} onClick=${() => setMoving(!moving.value)}>
        <${Icon} name=${moving.value ? "pause" : "play"} />
      </button>
      <input
        class="scrub" type="range" min="0" max="999" step="1" value=${position} aria-label=${STAGE.phase} aria-valuetext=${words}
        onInput=${(event) => holdPhase(event.target.valueAsNumber / 1000)}
      />
      <output class="percent">${percent}</output>
      <label class="pick speed">
        <span class="visually-hidden">${STAGE.speed}</span>
        <select value=${strobe.value ? `strobe ${strobe.value}` : slowdown.value} onChange=${choose}>
          <optgroup label=${STROBE.slow}>${RATES.map((n) => html`<option value=${n}>${STAGE.speedOf(n)}</option>`)}</optgroup>
          <optgroup label=${STROBE.name}>${STROBES.map((hz) => html`<option value=${`strobe ${hz}`}>${STROBE.locked(hz)}</option>`)}</optgroup>
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
