/** The bottom strip: state of phonation in words, the large numbers, the sound. */
import { html } from "../ui.js";
import { SoundControls } from "../controls/SoundControls.js";
import { result } from "../state/outcome.js";
import { HEADLINES } from "../texts.js";
import { Headline } from "./Headline.js";
import { PhonationState } from "./PhonationState.js";

export function Strip() {
  return html`
    <footer class="strip" data-result=${result.value?.id}>
      <${PhonationState} />
      <div class="headlines">${HEADLINES.map((item) => html`<${Headline} key=${item.key} item=${item} shown=${result.value} />`)}</div>
      <${SoundControls} />
    </footer>
  `;
}
