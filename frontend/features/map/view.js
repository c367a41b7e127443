/** The map over two parameters: its axes, its progress, the picture, its cells. */
import { html, useComputed, useEffect, useState } from "../../core/ui.js";
import { link } from "../../core/api.js";
import { numberText } from "../../core/axis.js";
import { capital } from "../../core/parameters.js";
import { STATES } from "../../core/texts.js";
import { palette } from "../../core/theme.js";
import { narrow } from "../../state/look.js";
import { catalogue, schema, values } from "../../state/request.js";
import { ActivationMap, CellLegend } from "./activation-map.js";
import { axisLabel, pictureOf, shownCells } from "./picture.js";
import { cancelMap, followSettings, loadCell, startMap } from "./run.js";
import {
  axes,
  difference,
  following,
  heldMap,
  holdMap,
  map,
  mapProblem,
  measure,
  MEASURES,
  running,
  setAxis,
  setDifference,
  setFollowing,
  setMeasure,
} from "./state.js";
import { samePoints } from "./sweep.js";
import { MAP } from "./texts.js";
import { Stage } from "../stage/view.js";

export function MapPanel() {
  useEffect(followSettings, []);
  const made = useComputed(() => map.value !== null).value;
  return html`
    <div class="map-panel">
      <${MapSetup} />
      <p class="refusal" role="alert">${mapProblem.value}</p>
      <${MapTools} />
      <div class="map-body">
        <div class="map-picture">
          ${
            made
              ? html`
                  <${MapPicture} />
                `
              : html`
                  <p class="map-empty">${MAP.empty}</p>
                `
          }
        </div>
        <aside class="map-side" aria-label=${MAP.cells}>
          ${
            made &&
            html`
              <${MapCells} cells=${shownCells.value} />
            `
          }
          ${
            !narrow.value &&
            html`
              <${Stage} compact=${true} />
            `
          }
        </aside>
      </div>
    </div>
  `;
}

function MapPicture() {
  const row = catalogue.value.get(measure.value);
  const [up, right] = map.value.table.axes.map(axisLabel);
  const taken = difference.value && heldMap.value && samePoints(heldMap.value.table, map.value.table);
  const name = `${row.name}${row.unit === "1" ? "" : ` (${row.unit})`}`;
  const heading = taken ? `${MAP.difference}: ${name}` : name;
  return html`
    <h3 class="map-title">${heading}</h3>
    <${ActivationMap}
      name="map"
      title=${MAP.title}
      heading=${heading}
      label=${MAP.picture(row.name, up, right)}
      map=${() => pictureOf(palette.value)}
      words=${MAP.states}
      onPick=${(x, y) => loadCell(map.peek(), [y, x])}
    />
  `;
}

const TIED = ["activation.lca", "activation.ia"];
const JOIN = "+";

export function MapSetup() {
  return html`
    <form class="map-setup" id="map-setup" onSubmit=${(event) => (event.preventDefault(), startMap())}>
      ${MAP.directions.map(
        (direction, place) => html`
          <${Axis} key=${place} place=${place} direction=${direction} />
        `,
      )}
    </form>
  `;
}

function Axis({ place, direction }) {
  const axis = useComputed(() => axes.value[place]).value;
  const choose = (event) => {
    const paths = event.target.value.split(JOIN);
    setAxis(place, { paths, ...usualRange(schema.peek().parameters.get(paths[0]), values.peek()[paths[0]]) });
  };
  const field = (key, words, mode) => html`
    <label class="pick">
      <span aria-hidden="true">${MAP.short[key]}</span>
      <input
        class="typed"
        type="text"
        inputmode=${mode}
        autocomplete="off"
        aria-label=${words(direction)}
        value=${axis[key]}
        onChange=${(event) => setAxis(place, { [key]: event.target.value.trim() })}
      />
    </label>
  `;
  return html`
    <fieldset class="map-axis">
      <legend>${direction}</legend>
      <select aria-label=${MAP.parameter(direction)} value=${axis.paths.join(JOIN)} onChange=${choose}>
        <${Parameters} />
      </select>
      <span class="map-range">
        ${field("from", MAP.from, "decimal")}${field("to", MAP.to, "decimal")}${field("steps", MAP.stepsOf, "numeric")}
      </span>
    </fieldset>
  `;
}

/** All numeric parameters, in the server's groups: the muscles first. */
function Parameters() {
  const numbers = [...schema.value.parameters.values()].filter(({ type }) => type === "number" || type === "integer");
  const named = (row) => (row.group === "muscles" ? `${row.name} (${row.short})` : row.name);
  const groups = [...new Set(numbers.map(({ group }) => group))];
  return groups.map(
    (group) => html`
      <optgroup key=${group} label=${capital(group)}>
        ${numbers
          .filter((row) => row.group === group)
          .map(
            (row) => html`
              <option value=${row.key}>${named(row)}</option>
            `,
          )}
        ${
          group === "muscles" &&
          html`
            <option value=${TIED.join(JOIN)}>${MAP.tied}</option>
          `
        }
      </optgroup>
    `,
  );
}

/** A muscle: its whole range. Another number: 0.5 to 1.5 times its value in force, within the allowed range. */
function usualRange({ group, min, max }, usual) {
  if (group === "muscles" || !usual) return { from: min, to: max };
  const [from, to] = [0.5 * usual, 1.5 * usual].sort((a, b) => a - b).map((value) => Number(value.toPrecision(6)));
  return { from: Math.max(from, min), to: Math.min(to, max) };
}

/** Start, progress and cancel: in another row, where the progress bar has room. */
export function MapRun() {
  const progress = running.value;
  if (!progress)
    return html`
      <div class="map-run">
        <button type="submit" form="map-setup" class="button">${map.value ? MAP.again : MAP.start}</button>
      </div>
    `;
  const { done, total } = progress;
  return html`
    <div class="map-run">
      <button type="button" class="button" onClick=${cancelMap}>${MAP.cancel}</button>
      <progress max=${total} value=${done} aria-label=${MAP.title}></progress>
      <span class="count">${MAP.progress(done, total)}</span>
    </div>
  `;
}

export function MapTools() {
  const made = map.value;
  const matches = made && heldMap.value && samePoints(heldMap.value.table, made.table);
  return html`
    <div class="map-tools">
      <label class="pick">
        <span>${MAP.measure}</span>
        <select value=${measure.value} onChange=${(event) => setMeasure(event.target.value)}>
          ${MEASURES.map(
            (key) => html`
              <option value=${key}>${catalogue.value.get(key).name}</option>
            `,
          )}
        </select>
      </label>
      <label class="check" title=${MAP.followHelp}>
        <input type="checkbox" checked=${following.value} onChange=${(event) => setFollowing(event.target.checked)} />
        ${MAP.follow}
      </label>
      <span class="map-compare">
        <button type="button" class="quiet" disabled=${!made} title=${MAP.keepHelp} onClick=${holdMap}>
          ${MAP.keep}
        </button>
        <button
          type="button"
          class="quiet"
          aria-pressed=${difference.value}
          disabled=${!matches}
          title=${heldMap.value && made && !matches ? MAP.otherPoints : MAP.differenceHelp}
          onClick=${() => setDifference(!difference.value)}
        >
          ${MAP.difference}
        </button>
      </span>
      ${
        made?.job.status === "successful" &&
        html`
          <span class="map-files">
            ${MAP.files}${" "}
            <a href=${link(`jobs/${made.job.id}/result.csv`)} download>${MAP.csv}</a>
            ${" "}
            <a href=${link(`jobs/${made.job.id}/result.nc`)} download>${MAP.netcdf}</a>
          </span>
        `
      }
      <${MapRun} />
    </div>
  `;
}

export function MapCells({ cells }) {
  const { states } = cells;
  const { reasons, problems } = map.value.table;
  const periodic = ({ points }) => points.some((k) => states[k] === "unvalued");
  const why = [
    ...(reasons[measure.value] ?? []).filter(periodic).map(({ reason }) => reason),
    ...problems.slice(0, 1).map(({ detail }) => detail),
  ];
  return html`
    <p>${MAP.voiced(map.value.table.states.filter((state) => state === "periodic").length, states.length)}</p>
    <${CellLegend} states=${states} words=${MAP.states} counted=${MAP.counted} />
    <p class="current-mark">
      <b aria-hidden="true">⊕</b>
      ${" "}${MAP.states.current}
    </p>
    ${why.map(
      (reason) => html`
        <p class="caution">${reason}</p>
      `,
    )}
    <${CellPicker} cells=${cells} />
  `;
}

/** Choose a cell and read its value without a pointer. */
function CellPicker({ cells }) {
  const { axes } = map.value.table;
  const [chosen, setChosen] = useState([0, 0]);
  const place = axes.map(({ values }, k) => Math.min(chosen[k], values.length - 1));
  const cell = place[0] * axes[1].values.length + place[1];
  return html`
    <div class="case-picker" role="group" aria-label=${MAP.pick}>
      ${axes.map(
        (axis, k) => html`
          <label class="pick" key=${axis.paths[0]}>
            <span>${axisLabel(axis)}</span>
            <select
              value=${place[k]}
              onChange=${(event) => setChosen(place.map((v, i) => (i === k ? Number(event.target.value) : v)))}
            >
              ${axis.values.map(
                (value, at) => html`
                  <option value=${at}>${Number(value.toPrecision(4))}</option>
                `,
              )}
            </select>
          </label>
        `,
      )}
      <output>${valueText(cells, cell)}</output>
      <button
        type="button"
        class="button"
        onClick=${() =>
          loadCell(
            map.peek(),
            place.map((at, k) => axes[k].values[at]),
          )}
      >
        ${MAP.load}
      </button>
    </div>
  `;
}

function valueText({ values, states }, cell) {
  const { unit, decimals } = catalogue.value.get(measure.value);
  if (values[cell] !== null) return `${numberText(values[cell], decimals)}${unit === "1" ? "" : ` ${unit}`}`;
  return MAP.states[states[cell]] ?? STATES[states[cell]] ?? MAP.waiting;
}
