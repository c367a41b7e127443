/** Contact over PCA: the largest pressure, and its place. */
import { html } from "../../core/ui.js";
import { niceCeil } from "../../core/axis.js";
import { PlotlyPlace } from "../../core/plotly.js";
import { fontFamily, palette } from "../../core/theme.js";
import { values } from "../../state/request.js";
import { CasePicker, Claims, FigureTools, openCase } from "./parts.js";
import { figures } from "./state.js";
import { PAPER } from "./texts.js";

const KEY = "pca_sweep";
const CURVES = [
  { key: "contact_pressure_max_pa", name: PAPER.pressure, unit: PAPER.pressureUnit, factor: 1e-3, claims: ["P2"] },
  { key: "contact_location", name: PAPER.location, unit: PAPER.locationUnit, factor: 1, range: [0, 1], claims: ["P3"] },
];

function curveOf({ key, unit, factor, range = undefined }) {
  const { axes, measures } = figures.value[KEY];
  const y = measures[key].map((v) => (v === null ? null : v * factor));
  const limits = range ?? [0, niceCeil(1.05 * Math.max(...y.filter((v) => v !== null)))];
  return levelCurveFigure(
    { x: axes[0].values, y, xLabel: PAPER.pca, yLabel: unit, range: limits, current: values.value["activation.pca"] },
    palette.value,
  );
}

export function PaperPca() {
  const figure = figures.value[KEY];
  return html`
    <div class="paper-row">
      <span class="unit">${PAPER.pcaFixed}</span>
      <${CasePicker} figure=${figure} />
      <${FigureTools} figure=${figure} />
    </div>
    ${CURVES.map(
      (curve) => html`
        <figure class="paper-figure" key=${curve.key} aria-labelledby=${`title-${curve.key}`}>
          <figcaption><h3 id=${`title-${curve.key}`}>${curve.name}</h3></figcaption>
          <div class="paper-picture">
            <${PlotlyPlace}
              name=${curve.key}
              label=${curve.name}
              figure=${() => curveOf(curve)}
              onPick=${({ x }) => openCase(figure, [x])}
            />
          </div>
          <${Claims} keys=${curve.claims} />
        </figure>
      `,
    )}
  `;
}

/** A measure over one activation as a Plotly figure: line and points, with gaps where nothing repeats. Pure. */
export function levelCurveFigure({ x, y, xLabel, yLabel, range, current }, colours) {
  const font = {
    family: fontFamily(),
    size: 12.5,
    color: colours.ink,
  };
  const axis = {
    gridcolor: colours.grid,
    linecolor: colours.line,
    zeroline: false,
    ticks: "outside",
    tickcolor: colours.line,
    nticks: 6,
    fixedrange: true,
  };
  const line = { color: colours.contact, width: 2 };
  return {
    traces: [
      {
        type: "scatter",
        mode: "lines+markers",
        x,
        y,
        line,
        marker: { size: 7, color: colours.contact },
        connectgaps: false,
        hovertemplate: `${xLabel} %{x:.3f}<br><b>%{y:.4~g}</b><extra></extra>`,
      },
    ],
    layout: {
      paper_bgcolor: "rgba(0,0,0,0)",
      plot_bgcolor: "rgba(0,0,0,0)",
      font,
      dragmode: false,
      hovermode: "closest",
      showlegend: false,
      margin: { l: 54, r: 12, t: 8, b: 42 },
      hoverlabel: { bgcolor: colours.panel, bordercolor: colours.line, font: { color: colours.ink } },
      xaxis: { ...axis, title: { text: xLabel, standoff: 6, font }, range: [-0.02, 1.02] },
      yaxis: { ...axis, title: { text: yLabel, standoff: 6, font }, range },
      shapes: [
        {
          type: "line",
          xref: "x",
          yref: "paper",
          x0: current,
          x1: current,
          y0: 0,
          y1: 1,
          line: { color: colours.cursor, width: 1, dash: "dot" },
        },
      ],
    },
  };
}
