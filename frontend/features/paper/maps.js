/** The five maps over CT and TA. */
import { computed, html } from "../../core/ui.js";
import { values } from "../../state/request.js";
import { ActivationMap, CellLegend } from "../map/activation-map.js";
import { mapStates } from "./figures.js";
import { CasePicker, Claims, FigureTools, openCase } from "./parts.js";
import { figures } from "./state.js";
import { PAPER } from "./texts.js";

const KEY = "ct_ta_map";
const states = computed(() => mapStates(figures.value[KEY]));

/** One map: CT up, TA to the right. A subharmonic cell has no single pitch. */
function mapOf(key) {
  const { axes, measures } = figures.value[KEY];
  const { unit, decimals } = PAPER.measures[key];
  const has = (state) => state === "voice" || (state === "subharmonic" && key !== "fo_hz");
  const v = values.value;
  return {
    y: { label: "CT", values: axes[0].values },
    x: { label: "TA", values: axes[1].values },
    values: measures[key].map((value, k) => (has(states.value[k]) ? value : null)),
    states: states.value,
    unit,
    decimals,
    current: { x: v["activation.ta"], y: v["activation.ct"] },
  };
}

export function PaperMaps() {
  const figure = figures.value[KEY];
  return html`
    <div class="paper-row">
      <span class="unit">${PAPER.mapFixed}</span>
      <${CasePicker} figure=${figure} />
      <${FigureTools} figure=${figure} />
    </div>
    ${Object.entries(PAPER.measures).map(
      ([key, { name, unit, claims }]) => html`
        <figure class="paper-figure" key=${key} aria-labelledby=${`title-${key}`}>
          <figcaption>
            <h3 id=${`title-${key}`}>${name}</h3>
            <span class="unit">${unit}</span>
          </figcaption>
          <div class="paper-picture">
            <${ActivationMap}
              name=${key}
              label=${PAPER.mapPicture(name)}
              map=${() => mapOf(key)}
              words=${PAPER.states}
              onPick=${(ta, ct) => openCase(figure, [ct, ta])}
            />
          </div>
          <${Claims} keys=${claims} compact=${claims.length > 2} />
        </figure>
      `,
    )}
    <aside class="cells" aria-label=${PAPER.noVoice}>
      <h3>${PAPER.noVoice}</h3>
      <${CellLegend} states=${states.value} words=${PAPER.states} counted=${PAPER.counted} />
      <p class="current-mark">
        <b aria-hidden="true">⊕</b>
        ${" "}${PAPER.states.current}
      </p>
    </aside>
  `;
}
