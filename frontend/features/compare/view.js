/** A and B: the settings and measures that differ, waves or folds of both, and buttons to hear them. */
import { computed, html, useComputed } from "../../core/ui.js";
import { numberText } from "../../core/axis.js";
import { MathsSymbol } from "../../core/maths-symbol.js";
import { Picture } from "../../core/picture.js";
import { STATES } from "../../core/texts.js";
import { palette, rootPx, smallFont } from "../../core/theme.js";
import { phase, readout } from "../../state/motion.js";
import { catalogue, restorePatch, schema, valuesOf } from "../../state/request.js";
import { settled } from "../../state/settled.js";
import { cycleOf, drawComparison } from "./cycles.js";
import { compareMode, hear, heard, held, hold, release, second, setCompareMode } from "./state.js";
import { COMPARE } from "./texts.js";
import { differingSettings, valueOf } from "../controls/settings-text.js";
import { columnOf, drawColumns } from "../folds/cycle-strip.js";
import { FOLDS } from "../folds/texts.js";
import { HEADLINES } from "../measures/texts.js";
import { valueText } from "../measures/value-text.js";
import { contactScale, pressureScale } from "../surface/view.js";
import { WAVES } from "../waves/texts.js";

const SHORT = { ...Object.fromEntries(HEADLINES.map(({ key, label }) => [key, label])), ...COMPARE.short };
const ROWS = Object.keys(SHORT);

const cycleA = computed(() => held.value.a && cycleOf(held.value.a.result));
const cycleB = computed(() => {
  const shown = held.value.b?.result ?? settled.value;
  return shown && cycleOf(shown);
});

function wavesModel() {
  if (!held.value.a) return null;
  return { a: cycleA.value, b: cycleB.value, mode: compareMode.value, colours: palette.value, names: WAVES };
}

const paint = (context, box, model) => drawComparison(context, box, model, rootPx(), smallFont(), COMPARE);

/** Both voices at the shared phase, under the same limits. */
function foldsModel() {
  const both = [held.value.a?.result.fields, (held.value.b?.result ?? settled.value)?.fields];
  if (!both[0] || !both[1]) return null;
  const columns = both.map((fields, k) => ({
    ...columnOf(fields, phase.value, "AB"[k]),
    colour: [palette.value.voiceA, palette.value.voiceB][k],
  }));
  const range = (name) => ({
    min: Math.min(...both.map((fields) => fields[name].min)),
    max: Math.max(...both.map((fields) => fields[name].max)),
  });
  const shared = { aeroRange: range("aeroRange"), contactRange: range("contactRange") };
  return {
    columns,
    reach: Math.max(...both.map(reachOf)),
    long: Math.max(...columns.map(({ edges }) => edges.lengthMm)),
    scales: { aero: pressureScale(shared), contact: contactScale(shared) },
    colours: palette.value,
  };
}

const reaches = new WeakMap();

/** Largest distance of an edge from the midline in the cycle, mm. */
function reachOf(fields) {
  if (!reaches.has(fields)) {
    const all = Array.from({ length: fields.phases }, (_, k) => columnOf(fields, k / fields.phases).edges);
    reaches.set(fields, Math.max(1, ...all.flatMap(({ superior, inferior }) => [...superior, ...inferior])));
  }
  return reaches.get(fields);
}

const paintFolds = (context, box, model) => drawColumns(context, box, model, rootPx(), smallFont(), FOLDS.strip);

export function ComparePanel() {
  const { a, b } = held.value;
  return html`
    <div class="compare">
      <div class="compare-actions">
        <button
          type="button"
          class="button mark-a"
          aria-pressed=${a !== null}
          title=${COMPARE.holdHelp.a}
          onClick=${() => hold("a")}
        >
          ${COMPARE.hold.a}
        </button>
        <button
          type="button"
          class="button mark-b"
          aria-pressed=${b !== null}
          title=${COMPARE.holdHelp.b}
          onClick=${() => (b ? release("b") : hold("b"))}
        >
          ${b ? COMPARE.free : COMPARE.hold.b}
        </button>
        ${
          a &&
          html`
            <button type="button" class="quiet" onClick=${() => restorePatch(a.patch)}>${COMPARE.back}</button>
            <button type="button" class="quiet" onClick=${() => release("a")}>${COMPARE.forget}</button>
          `
        }
      </div>
      ${
        a
          ? html`
              <${Pair} a=${a} b=${second.value} live=${!b} />
            `
          : html`
              <p>${COMPARE.start}</p>
            `
      }
    </div>
  `;
}

function Pair({ a, b, live }) {
  const settings = differingSettings(schema.value, a.patch, b.patch);
  const [valuesA, valuesB] = [valuesOf(a.patch), valuesOf(b.patch)];
  return html`
    <div class="compare-hear" role="group" aria-label=${COMPARE.hearHelp}>
      ${["a", "b", "turn"].map(
        (which) => html`
          <button
            key=${which}
            type="button"
            class="button"
            aria-pressed=${heard.value === which}
            title=${COMPARE.hearHelp}
            onClick=${() => hear(which)}
          >
            ${heard.value === which ? COMPARE.stop : COMPARE.hear[which]}
          </button>
        `,
      )}
      <span class="when">${COMPARE.hearHelp}</span>
    </div>
    <table class="compare-table">
      <thead>
        <tr>
          <th scope="col">${COMPARE.measure}</th>
          <th scope="col" class="mark-a">A</th>
          <th scope="col" class="mark-b">
            B${" "}
            <span class="when">${live ? COMPARE.live : COMPARE.heldMark}</span>
          </th>
          <th scope="col">${COMPARE.difference}</th>
        </tr>
      </thead>
      <tbody>
        ${
          a.result.state !== b.result.state &&
          html`
            <tr class="states">
              <th scope="row">${COMPARE.state}</th>
              <td>${STATES[a.result.state]}</td>
              <td>${STATES[b.result.state]}</td>
              <td></td>
            </tr>
          `
        }
        ${settings.map(
          (row) => html`
            <tr key=${row.key} class="setting">
              <th scope="row">${row.name}</th>
              <td>${valueOf(row, valuesA)}</td>
              <td>${valueOf(row, valuesB)}</td>
              <td></td>
            </tr>
          `,
        )}
        ${
          !settings.length &&
          html`
            <tr class="setting"><th colspan="4" scope="colgroup">${COMPARE.sameSettings}</th></tr>
          `
        }
        ${ROWS.map(
          (key) => html`
            <${MeasureRow}
              key=${key}
              row=${catalogue.value.get(key)}
              a=${a.result.measures[key]}
              b=${b.result.measures[key]}
            />
          `,
        )}
      </tbody>
    </table>
    <figure class="plot">
      <figcaption>
        <h2>
          ${
            compareMode.value === "folds"
              ? html`
                  <${FoldsTitle} />
                `
              : COMPARE.waves
          }
        </h2>
        <div class="segments small" role="group" aria-label=${COMPARE.modeName}>
          ${Object.entries(COMPARE.mode).map(
            ([mode, text]) => html`
              <button
                key=${mode}
                type="button"
                class="segment"
                aria-pressed=${compareMode.value === mode}
                onClick=${() => setCompareMode(mode)}
              >
                <span>${text}</span>
              </button>
            `,
          )}
        </div>
      </figcaption>
      ${
        compareMode.value === "folds"
          ? html`
              <${Picture}
                key="folds"
                name="compare-folds"
                title=${COMPARE.title}
                model=${foldsModel}
                paint=${paintFolds}
                label=${COMPARE.foldsPicture}
              />
            `
          : html`
              <${Picture}
                key="waves"
                name="compare"
                title=${COMPARE.title}
                model=${wavesModel}
                paint=${paint}
                label=${COMPARE.picture}
              />
            `
      }
    </figure>
  `;
}

function FoldsTitle() {
  return html`
    ${useComputed(() => COMPARE.folds(Math.floor(100 * readout.value)))}
  `;
}

function MeasureRow({ row, a, b }) {
  return html`
    <tr data-compared=${row.key}>
      <th scope="row">
        ${SHORT[row.key]}${" "}
        <${MathsSymbol} text=${row.symbol} />
      </th>
      <td>${valueText(a, row)}</td>
      <td>${valueText(b, row)}</td>
      <td class="change">${changeText(row, a, b)}</td>
    </tr>
  `;
}

/** B − A with its sign; a dash where either has no value. Pure. */
export function changeText(row, a, b) {
  if (a?.value == null || b?.value == null) return COMPARE.none;
  const change = b.value - a.value;
  const text = numberText(change, row.decimals);
  return change > 0 && Number(change.toFixed(row.decimals)) !== 0 ? `+${text}` : text;
}
