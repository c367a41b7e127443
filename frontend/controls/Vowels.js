/** The vowel: eleven buttons in the order of the vowel chart's rim. */
import { html, useComputed } from "../ui.js";
import { problems } from "../state/outcome.js";
import { schema, setValue, values } from "../state/request.js";
import { Refusal } from "./Refusal.js";

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
              <input type="radio" name="vowel" value=${key} checked=${key === chosen} aria-label=${label} onChange=${() => setValue("vowel", key)} />
              <span>${ipa}</span>
            </label>
          `,
        )}
      </div>
      ${problem && html`<${Refusal} problem=${problem} />`}
    </fieldset>
  `;
}
