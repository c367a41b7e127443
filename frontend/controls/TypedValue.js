/** The value of a parameter as text that can be typed over; the server decides whether it can be used. */
import { html, useComputed, useRef } from "../ui.js";
import { problems } from "../state/outcome.js";
import { schema, setValue, values } from "../state/request.js";
import { typed } from "../params.js";
import { CONTROL } from "../texts.js";

export function TypedValue({ path, id, placeholder, label, wide = false }) {
  const row = schema.value.parameters.get(path);
  const value = useComputed(() => values.value[path]).value;
  const refused = useComputed(() => path in problems.value).value;
  const field = useRef(null);
  const text = textOf(value, row);
  const commit = () => {
    if (field.current.value === text) return;
    const wanted = typed(field.current.value);
    if (wanted === null && !row.nullable) field.current.value = text;
    else setValue(path, wanted);
  };
  return html`<input
    ref=${field} id=${id} class=${wide ? "typed wide" : "typed"} type="text" inputmode="decimal" autocomplete="off" spellcheck=${false}
    value=${text} placeholder=${placeholder} aria-label=${label ?? (id ? undefined : CONTROL.typed(row.short ? `${row.name} (${row.short})` : row.name))}
    aria-invalid=${refused ? "true" : undefined}
    onChange=${commit} onFocus=${(event) => event.target.select()}
    onKeyDown=${(event) => event.key === "Escape" && ((field.current.value = text), field.current.blur())}
  />`;
}

/** As many decimals as the step has, or all that were typed. */
export function textOf(value, row) {
  if (value === null || value === undefined) return "";
  if (typeof value !== "number") return String(value);
  if (row.type === "integer" || Math.abs(value) >= 1e6 || (value !== 0 && Math.abs(value) < 1e-3)) return String(value);
  const rounded = value.toFixed(row.decimals);
  return Number(rounded) === value ? rounded : String(value);
}
