/** The controls on the left: five muscles, breath and tract, vowel, and the advanced settings. */
import { html, useComputed } from "../../core/ui.js";
import { numberText } from "../../core/axis.js";
import { partsGiven } from "../../core/parameters.js";
import { problems } from "../../state/answers.js";
import { muscleOf, musclePaths, patch, schema, setTied, setValue, tied, values } from "../../state/request.js";
import { Choice, NumberField, Refusal } from "./fields.js";
import { Slider } from "./slider.js";
import { CONTROL, GROUPS, ROLES } from "./texts.js";

export function Muscles() {
  return html`
    <section class="group" aria-labelledby="muscles-title">
      <div class="group-head">
        <h2 id="muscles-title">${GROUPS.muscles}</h2>
        <label class="check">
          <input type="checkbox" checked=${tied.value} onChange=${(event) => setTied(event.target.checked)} />
          ${GROUPS.tied}
        </label>
      </div>
      ${musclePaths().map(
        (path) => html`
          <${Slider} key=${path} path=${path} colour=${`--${muscleOf(path)}`} role=${ROLES[path]} />
        `,
      )}
    </section>
  `;
}

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

export function Vowels() {
  const { parameters, vowels } = schema.value;
  const chosen = useComputed(() => values.value.vowel).value;
  const problem = useComputed(() => problems.value.vowel).value;
  return html`
    <fieldset class="control vowels">
      <legend class="control-head">
        <span class="control-name">${parameters.get("vowel").name}</span>
        <span class="vowel-word">${vowels.find((row) => row.key === chosen)?.label}</span>
      </legend>
      <div class="segments">
        ${vowels.map(
          ({ key, ipa, label }) => html`
            <label class="segment" title=${label}>
              <input
                type="radio"
                name="vowel"
                value=${key}
                checked=${key === chosen}
                aria-label=${label}
                onChange=${() => setValue("vowel", key)}
              />
              <span>${ipa}</span>
            </label>
          `,
        )}
      </div>
      ${
        problem &&
        html`
          <${Refusal} problem=${problem} />
        `
      }
    </fieldset>
  `;
}

// Everything else is here, so that a new part of the request needs no edit. Constants are set in maps and links.
const GROUPS_ELSEWHERE = new Set(["muscles", "breath", "tract", "constants", "posturing constants"]);
const ELSEWHERE = new Set(["model.variant", "convergence_angle_rad", "run.error_estimate"]);

export function Advanced() {
  const rows = [...schema.value.parameters.values()].filter(
    (row) => !GROUPS_ELSEWHERE.has(row.group) && !ELSEWHERE.has(row.key) && !(row.options?.length === 1),
  );
  const given = partsGiven(schema.value, patch.value);
  const placeholderOf = ({ optional_part: part, nullable }) => {
    if (part && !given.has(part)) return CONTROL.withoutPart[part] ?? CONTROL.notGiven;
    return nullable ? CONTROL.automatic : "";
  };
  return html`
    <details
      class="group advanced"
      onToggle=${(event) => event.target.open && event.target.scrollIntoView({ block: "start" })}
    >
      <summary><h2>${GROUPS.advanced}</h2></summary>
      <div class="fields">
        ${rows.map((row) =>
          row.options
            ? html`
                <${Choice} key=${row.key} path=${row.key} />
              `
            : html`
                <${NumberField} key=${row.key} path=${row.key} placeholder=${placeholderOf(row)} />
              `,
        )}
      </div>
    </details>
  `;
}
