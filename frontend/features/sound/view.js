/** The sound of the result: listen, volume, repeat, download. */
import { html } from "../../core/ui.js";
import { link } from "../../core/api.js";
import { Icon } from "../../core/widgets.js";
import { result } from "../../state/answers.js";
import { looping, playing, setLooping, setVolume, toggleSound, volume } from "./sound.js";
import { SOUND } from "./texts.js";

export function SoundControls() {
  const shown = result.value;
  return html`
    <div class="sound">
      <button
        type="button"
        class="listen"
        aria-pressed=${playing.value}
        disabled=${!shown}
        title=${`${SOUND.play} (Space)`}
        onClick=${toggleSound}
      >
        <${Icon} name=${playing.value ? "stop" : "play"} />
        <span>${playing.value ? SOUND.pause : SOUND.play}</span>
      </button>
      <label class="volume">
        <span class="visually-hidden">${SOUND.volume}</span>
        <input
          type="range"
          min="0"
          max="1"
          step="0.05"
          value=${volume.value}
          title=${SOUND.volume}
          onInput=${(event) => setVolume(event.target.valueAsNumber)}
        />
      </label>
      <div class="sound-tools">
        <button
          type="button"
          class="icon"
          aria-pressed=${looping.value}
          aria-label=${SOUND.loop}
          title=${SOUND.loopHelp}
          onClick=${() => setLooping(!looping.value)}
        >
          <${Icon} name="repeat" />
        </button>
        <a
          class=${shown ? "icon" : "icon off"}
          href=${shown ? link(`jobs/${shown.id}/audio.wav`) : undefined}
          download="vocalis.wav"
          aria-label=${SOUND.saveHelp}
          title=${SOUND.saveHelp}
        >
          <${Icon} name="save" />
        </a>
      </div>
    </div>
  `;
}
