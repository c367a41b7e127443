/** A number that is typed rather than dragged. */
import { html, useComputed } from "../ui.js";
import { problems } from "../state/outcome.js";
import { schema } from "../state/request.js";
import { controlId } from "./focus.js";
import { Refusal } from "./Refusal.js";
import { TypedValue } from "./TypedValue.js";

export function NumberField({ path, placeholder }) {
  const row = schema.value.parameters.get(path);
  const problem = useComputed(() => problems.value[path]).value;
  const id = controlId(path);
  return html`
    <div class="field" title=${row.help}>
      <label for=${id}>${row.name}${row.unit !== "1" && html` <span class="unit">${row.unit}</span>`}</label>
      <${TypedValue} path=${path} id=${id} placeholder=${placeholder} wide=${true} />
      ${problem && html`<${Refusal} problem=${problem} />`}
    </div>
  `;
}
