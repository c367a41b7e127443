/** One of a few options as a list to choose from. */
import { html, useComputed } from "../ui.js";
import { problems } from "../state/outcome.js";
import { schema, setValue, values } from "../state/request.js";
import { CONTROL, OPTION_NAMES } from "../texts.js";
import { controlId } from "./focus.js";
import { Refusal } from "./Refusal.js";

export function Choice({ path }) {
  const row = schema.value.parameters.get(path);
  const value = useComputed(() => values.value[path]).value;
  const problem = useComputed(() => problems.value[path]).value;
  const id = controlId(path);
  return html`
    <div class="field">
      <label for=${id}>${row.name}</label>
      <select id=${id} value=${value ?? ""} title=${row.help} onChange=${(event) => setValue(path, event.target.value || null)}>
        ${row.nullable && html`<option value="">${CONTROL.ownChoice}</option>`}
        ${row.options.map((option) => html`<option value=${option}>${OPTION_NAMES[option] ?? option}</option>`)}
      </select>
      ${problem && html`<${Refusal} problem=${problem} />`}
    </div>
  `;
}
