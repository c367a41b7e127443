/** The cause: five muscles. */
import { html } from "../ui.js";
import { muscleOf, musclePaths } from "../state/muscles.js";
import { setTied, tied } from "../state/request.js";
import { GROUPS, ROLES } from "../texts.js";
import { Slider } from "./Slider.js";

export function Muscles() {
  return html`
    <section class="group" aria-labelledby="muscles-title">
      <div class="group-head">
        <h2 id="muscles-title">${GROUPS.muscles}</h2>
        <label class="check"><input type="checkbox" checked=${tied.value} onChange=${(event) => setTied(event.target.checked)} />${GROUPS.tied}</label>
      </div>
      ${musclePaths().map((path) => html`<${Slider} key=${path} path=${path} colour=${`--${muscleOf(path)}`} role=${ROLES[path]} />`)}
    </section>
  `;
}
