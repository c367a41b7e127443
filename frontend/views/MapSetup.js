/** What to map: two parameters with their ranges; and the start, how far it is, and the stop. */
import { html, useComputed } from "../ui.js";
import { cancelMap, startMap } from "../map.js";
import { capital } from "../params.js";
import { axes, map, running, setAxis } from "../state/map.js";
import { schema } from "../state/request.js";
import { MAP } from "../texts.js";

const TIED = ["activation.lca", "activation.ia"];
const JOIN = "+";

export function MapSetup() {
  return html`
    <form class="map-setup" id="map-setup" onSubmit=${(event) => (event.preventDefault(), startMap())}>
      ${MAP.directions.map((direction, place) => html`<${Axis} key=${place} place=${place} direction=${direction} />`)}
    </form>
  `;
}

function Axis({ place, direction }) {
  const axis = useComputed(() => axes.value[place]).value;
  const choose = (event) => {
    const paths = event.target.value.split(JOIN);
    setAxis(place, { paths, ...usualRange(schema.peek().parameters.get(paths[0])) });
  };
  const field = (key, words, mode) => html`
    <label class="pick"><span aria-hidden="true">${MAP.short[key]}</span>
      <input class="typed" type="text" inputmode=${mode} autocomplete="off" aria-label=${words(direction)} value=${axis[key]} onChange=${(event) => setAxis(place, { [key]: event.target.value.trim() })} />
    </label>
  `;
  return html`
    <fieldset class="map-axis">
      <legend>${direction}</legend>
      <select aria-label=${MAP.parameter(direction)} value=${axis.paths.join(JOIN)} onChange=${choose}><${Parameters} /></select>
      <span class="map-range">${field("from", MAP.from, "decimal")}${field("to", MAP.to, "decimal")}${field("steps", MAP.stepsOf, "numeric")}</span>
    </fieldset>
  `;
}

/** Every number there is, by group as the server orders them: the muscles first. */
function Parameters() {
  const numbers = [...schema.value.parameters.values()].filter(({ type }) => type === "number" || type === "integer");
  const named = (row) => (row.group === "muscles" ? `${row.name} (${row.short})` : row.name);
  const groups = [...new Set(numbers.map(({ group }) => group))];
  return groups.map((group) => html`
    <optgroup key=${group} label=${capital(group)}>
      ${numbers.filter((row) => row.group === group).map((row) => html`<option value=${row.key}>${named(row)}</option>`)}
      ${group === "muscles" && html`<option value=${TIED.join(JOIN)}>${MAP.tied}</option>`}
    </optgroup>
  `);
}

/** All of a muscle; of another number half to one and a half times its default, or all that is allowed. */
function usualRange({ group, default: usual, min, max }) {
  if (group === "muscles" || !usual) return { from: min, to: max };
  const [from, to] = [0.5 * usual, 1.5 * usual].sort((a, b) => a - b).map((value) => Number(value.toPrecision(6)));
  return { from: Math.max(from, min), to: Math.min(to, max) };
}

/** Stands in another row, where it has room for the progress. */
export function MapRun() {
  const progress = running.value;
  if (!progress) return html`<div class="map-run"><button type="submit" form="map-setup" class="button">${map.value ? MAP.again : MAP.start}</button></div>`;
  const { done, total } = progress;
  return html`
    <div class="map-run">
      <button type="button" class="button" onClick=${cancelMap}>${MAP.cancel}</button>
      <progress max=${total} value=${done} aria-label=${MAP.title}></progress><span class="count">${MAP.progress(done, total)}</span>
    </div>
  `;
}
