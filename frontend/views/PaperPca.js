/** Contact over PCA: how hard at most, and where. */
import { html } from "../ui.js";
import { niceCeil } from "../plots/axis.js";
import { levelCurveFigure } from "../plots/level-curve.js";
import { palette } from "../plots/theme.js";
import { figures } from "../state/paper.js";
import { values } from "../state/request.js";
import { PAPER } from "../texts.js";
import { CasePicker } from "./CasePicker.js";
import { Claims } from "./Claims.js";
import { FigureTools, openCase } from "./FigureTools.js";
import { PlotlyPlace } from "./PlotlyPlace.js";

const KEY = "pca_sweep";
const CURVES = [
  { key: "contact_pressure_max_pa", name: PAPER.pressure, unit: PAPER.pressureUnit, factor: 1e-3, claims: ["P2"] },
  { key: "contact_location", name: PAPER.location, unit: PAPER.locationUnit, factor: 1, range: [0, 1], claims: ["P3"] },
];

function curveOf({ key, unit, factor, range }) {
  const { axes, measures } = figures.value[KEY];
  const y = measures[key].map((v) => (v === null ? null : v * factor));
  const limits = range ?? [0, niceCeil(1.05 * Math.max(...y.filter((v) => v !== null)))];
  return levelCurveFigure({ x: axes[0].values, y, xLabel: PAPER.pca, yLabel: unit, range: limits, current: values.value["activation.pca"] }, palette.value);
}

export function PaperPca() {
  const figure = figures.value[KEY];
  return html`
    <div class="paper-row"><span class="unit">${PAPER.pcaFixed}</span><${CasePicker} figure=${figure} /><${FigureTools} figure=${figure} /></div>
    ${CURVES.map((curve) => html`
      <figure class="paper-figure" key=${curve.key} aria-labelledby=${`title-${curve.key}`}>
        <figcaption><h3 id=${`title-${curve.key}`}>${curve.name}</h3></figcaption>
        <div class="paper-picture"><${PlotlyPlace} name=${curve.key} label=${curve.name} figure=${() => curveOf(curve)} onPick=${({ x }) => openCase(figure, [x])} /></div>
        <${Claims} keys=${curve.claims} />
      </figure>
    `)}
  `;
}
