/** Fields for one parameter: a typed value, a number, a choice; and why the server refused it. */
import { html, useComputed, useRef } from "../../core/ui.js";
import { typed } from "../../core/parameters.js";
import { problems } from "../../state/answers.js";
import { patch, schema, setValue, values } from "../../state/request.js";
import { CONTROL, OPTION_NAMES } from "./texts.js";

/** Focus a control from anywhere by its parameter path (keys 1–5, tests, links in hints). */
export function focusControl(path) {
  document.getElementById(controlId(path))?.focus();
}

export const controlId = (path) => `control-${path.replaceAll(".", "-")}`;

export function TypedValue({ path, id, placeholder, label, wide = false }) {
  const row = schema.value.parameters.get(path);
  const value = useComputed(() => values.value[path]).value;
  const refused = useComputed(() => path in problems.value).value;
  const field = useRef(null);
  const text = textOf(value, row);
  const commit = () => {
    if (field.current.value === text) return;
    const wanted = typed(field.current.value);
    if (wanted !== null || row.nullable) setValue(path, wanted);
    field.current.value = textOf(values.peek()[path], row); // an emptied field shows the value in force
  };
  return html`
    <input
      ref=${field}
      id=${id}
      class=${wide ? "typed wide" : "typed"}
      type="text"
      inputmode="decimal"
      autocomplete="off"
      spellcheck=${false}
      value=${text}
      placeholder=${placeholder}
      aria-label=${label ?? (id ? undefined : CONTROL.typed(row.short ? `${row.name} (${row.short})` : row.name))}
      aria-invalid=${refused ? "true" : undefined}
      onChange=${commit}
      onFocus=${(event) => event.target.select()}
      onKeyDown=${(event) => event.key === "Escape" && ((field.current.value = text), field.current.blur())}
    />
  `;
}

/** As many decimals as the step has, or all that were typed. */
export function textOf(value, row) {
  if (value === null || value === undefined) return "";
  if (typeof value !== "number") return String(value);
  if (row.type === "integer" || Math.abs(value) >= 1e6 || (value !== 0 && Math.abs(value) < 1e-3)) return String(value);
  const rounded = value.toFixed(row.decimals);
  return Number(rounded) === value ? rounded : String(value);
}

export function NumberField({ path, placeholder }) {
  const row = schema.value.parameters.get(path);
  const problem = useComputed(() => problems.value[path]).value;
  const id = controlId(path);
  return html`
    <div class="field" title=${row.help}>
      <label for=${id}>
        ${row.name}${
          row.unit !== "1" &&
          html`
            ${" "}
            <span class="unit">${row.unit}</span>
          `
        }
      </label>
      <${TypedValue} path=${path} id=${id} placeholder=${placeholder} wide=${true} />
      ${
        problem &&
        html`
          <${Refusal} problem=${problem} />
        `
      }
    </div>
  `;
}

/** The choice in force; one that the user made where the variant has its own can be taken back. */
export function Choice({ path }) {
  const row = schema.value.parameters.get(path);
  const withoutOwn = useComputed(() => row.nullable && (path in patch.value || values.value[path] === null)).value;
  const value = useComputed(() => values.value[path]).value;
  const problem = useComputed(() => problems.value[path]).value;
  const id = controlId(path);
  return html`
    <div class="field">
      <label for=${id}>${row.name}</label>
      <select
        id=${id}
        value=${String(value ?? "")}
        title=${row.help}
        onChange=${(event) => setValue(path, row.options.find((one) => String(one) === event.target.value) ?? null)}
      >
        ${
          withoutOwn &&
          html`
            <option value="">${row.optional_part ? CONTROL.notGiven : CONTROL.ownChoice}</option>
          `
        }
        ${row.options.map(
          (option) => html`
            <option value=${String(option)}>${OPTION_NAMES[option] ?? option}</option>
          `,
        )}
      </select>
      ${
        problem &&
        html`
          <${Refusal} problem=${problem} />
        `
      }
    </div>
  `;
}

export function Refusal({ problem }) {
  return html`
    <span class="refusal" role="alert">
      ${problem.message}.${" "}${problem.allowed && CONTROL.allowed(problem.allowed)}
    </span>
  `;
}
