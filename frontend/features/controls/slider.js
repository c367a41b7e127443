/** One number as a slider: name, typed value, track with its default marked, and one line of help or refusal. */
import { html, useComputed, useEffect, useRef } from "../../core/ui.js";
import { numberText } from "../../core/axis.js";
import { MathsSymbol } from "../../core/maths-symbol.js";
import { problems } from "../../state/answers.js";
import { defaults, resetValue, schema, setValue, values } from "../../state/request.js";
import { controlId, Refusal, TypedValue } from "./fields.js";
import { CONTROL } from "./texts.js";
import { prefetchAround } from "../live/posture-prefetch.js";

const LEAP = 10; // Shift moves by ten steps

/** `also(value)`: the value in a second unit; `role`: what the control does, in one line. */
export function Slider({ path, colour, role = "", also }) {
  const row = schema.value.parameters.get(path);
  const value = useComputed(() => values.value[path]).value;
  const problem = useComputed(() => problems.value[path]).value;
  const id = controlId(path);
  const share = (v) => (Math.max(row.min, Math.min(row.max, v)) - row.min) / (row.max - row.min);
  const own = useComputed(() => defaults.value[path]).value;
  const shown = Number.isFinite(value) ? value : own;
  const round = (v) => Number(v.toFixed(row.decimals));
  const track = useRef(null);
  useEffect(() => track.current.style.setProperty("--fill", `${100 * share(shown)}%`));

  const onKeyDown = (event) => {
    const direction = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
    if (!direction || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const next = shown + direction * row.step * (event.shiftKey ? LEAP : 1);
    setValue(path, round(Math.max(row.min, Math.min(row.max, next))));
  };

  return html`
    <div
      class="control"
      style=${colour ? { "--own": `var(${colour})` } : undefined}
      onPointerEnter=${() => prefetchAround(path)}
      onFocusIn=${() => prefetchAround(path)}
    >
      <div class="control-head">
        <label for=${id}>
          <span class="control-name">${row.name}</span>
          ${
            row.short &&
            html`
              <span class="chip"><${MathsSymbol} text=${row.short} /></span>
            `
          }
        </label>
        <${TypedValue} path=${path} />
        ${
          row.unit !== "1" &&
          html`
            <span class="unit">${row.unit}</span>
          `
        }
      </div>
      <div
        class="track"
        ref=${track}
        onDblClick=${() => resetValue(path)}
        title=${CONTROL.reset(numberText(own, row.decimals))}
      >
        <span
          class="default-tick"
          style=${{ left: `calc(var(--thumb) / 2 + (100% - var(--thumb)) * ${share(own)})` }}
        ></span>
        <input
          id=${id}
          type="range"
          min=${row.min}
          max=${row.max}
          step=${row.step}
          value=${shown}
          aria-describedby=${`${id}-help`}
          aria-invalid=${problem ? "true" : undefined}
          aria-valuetext=${`${numberText(shown, row.decimals)}${row.unit === "1" ? "" : ` ${row.unit}`}`}
          onInput=${(event) => setValue(path, round(event.target.valueAsNumber))}
          onKeyDown=${onKeyDown}
        />
      </div>
      <p class="control-help" id=${`${id}-help`}>
        ${
          problem
            ? html`
                <${Refusal} problem=${problem} />
              `
            : html`
                <span>${role}</span>
                ${
                  also &&
                  html`
                    <span class="also">${also(shown)}</span>
                  `
                }
              `
        }
      </p>
    </div>
  `;
}
