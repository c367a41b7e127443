/** Breath and tract: lung pressure, the glottis' convergence, the vowel. */
import { html } from "../ui.js";
import { numberText } from "../plots/axis.js";
import { GROUPS } from "../texts.js";
import { Slider } from "./Slider.js";
import { Vowels } from "./Vowels.js";

const PA_PER_CMH2O = 98.0665;

export function BreathAndTract() {
  return html`
    <section class="group" aria-labelledby="voice-title">
      <div class="group-head"><h2 id="voice-title">${GROUPS.voice}</h2></div>
      <${Slider} path="subglottal_pressure_pa" also=${(pa) => `${numberText(pa / PA_PER_CMH2O, 1)} cmH₂O`} />
      <${Slider} path="convergence_angle_rad" also=${(rad) => `${numberText((rad * 180) / Math.PI, 2)}°`} />
      <${Vowels} />
    </section>
  `;
}
