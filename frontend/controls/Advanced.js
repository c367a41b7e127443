/** What experts change: grid, step, start, posture set and the open questions of the model. Folded away. */
import { html } from "../ui.js";
import { schema } from "../state/request.js";
import { CONTROL, GROUPS } from "../texts.js";
import { Choice } from "./Choice.js";
import { NumberField } from "./NumberField.js";

const GROUPS_SHOWN = ["model", "run", "posture"];
const ELSEWHERE = new Set(["model.variant", "convergence_angle_rad", "run.error_estimate"]);

export function Advanced() {
  const rows = [...schema.value.parameters.values()].filter(
    (row) => GROUPS_SHOWN.includes(row.group) && !ELSEWHERE.has(row.key) && !(row.options?.length === 1),
  );
  return html`
    <details class="group advanced" onToggle=${(event) => event.target.open && event.target.scrollIntoView({ block: "start" })}>
      <summary><h2>${GROUPS.advanced}</h2></summary>
      <div class="fields">
        ${rows.map((row) =>
          row.options
            ? html`<${Choice} key=${row.key} path=${row.key} />`
            : html`<${NumberField} key=${row.key} path=${row.key} placeholder=${placeholderOf(row)} />`,
        )}
      </div>
    </details>
  `;
}

const placeholderOf = (row) => (row.key.startsWith("posture.") ? CONTROL.byMuscles : row.nullable ? CONTROL.automatic : "");
