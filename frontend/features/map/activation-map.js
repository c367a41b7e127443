/**
 * A measure over two parameters, or a difference of one, as a Plotly figure that can be clicked: colours, contours,
 * marks on cells without a plain voice, the posture that is set.
 */
import { html } from "../../core/ui.js";
import { divergingScale, rampScale } from "../../core/colours.js";
import { PlotlyPlace } from "../../core/plotly.js";
import { fontFamily, palette } from "../../core/theme.js";
import { narrow } from "../../state/look.js";

/** Marks of cells without a value. Each kind has its own sign, so colour is not needed. */
export const CELL_MARKS = {
  subharmonic: { symbol: "diamond-open", sign: "◇" },
  weak: { symbol: "circle-open", sign: "○" },
  irregular: { symbol: "x-thin-open", sign: "×" },
  unvalued: { symbol: "triangle-up-open", sign: "△" },
  none: { symbol: "line-ns-open", sign: "|" },
  failed: { symbol: "square-open", sign: "□" },
};

/**
 * `x`, `y`: {label, values, format, colour} (the last two may be left out); y is the first axis of `values`. `range`:
 * limits of the colours, or null for those of the values. `current`: {x, y} of the posture set, or null. `diverging`:
 * colours centred on 0. `markAll`: mark cells that have a value too. `words`: names of the states and of the marker.
 */
export function activationMapFigure(
  {
    x,
    y,
    values,
    states,
    unit,
    decimals,
    range = null,
    contours = 8,
    current = null,
    diverging = false,
    markAll = false,
  },
  colours,
  words,
  compact = false,
) {
  const nx = x.values.length;
  const rows = y.values.map((_, i) => values.slice(i * nx, (i + 1) * nx));
  const [low, high] =
    range ??
    limits(
      values.filter((v) => v !== null),
      diverging,
    );
  const ground = colours.theme === "dark" ? "#101416" : "#ffffff";
  const lineColour = diverging
    ? colours.inkSoft
    : colours.theme === "dark"
      ? "rgba(0,0,0,.55)"
      : "rgba(255,255,255,.75)";
  const place = `${y.label} %{y:${y.format ?? ".2f"}}, ${x.label} %{x:${x.format ?? ".2f"}}<br>`;
  const font = {
    family: fontFamily(),
    size: compact ? 11 : 12.5,
    color: colours.ink,
  };
  const axis = {
    zeroline: false,
    showgrid: false,
    linecolor: colours.line,
    ticks: "outside",
    tickcolor: colours.line,
    nticks: 6,
    fixedrange: true,
  };
  /** @type {object[]} */
  const traces = [
    {
      type: "heatmap",
      x: x.values,
      y: y.values,
      z: rows,
      zmin: low,
      zmax: high,
      colorscale: (diverging ? divergingScale : rampScale)(colours.theme),
      hoverongaps: false,
      hovertemplate: `${place}<b>%{z:.${decimals}f}</b> ${unit}<extra></extra>`,
      colorbar: { thickness: 11, outlinewidth: 0, len: 1, nticks: 6, tickfont: font },
    },
    {
      type: "contour",
      x: x.values,
      y: y.values,
      z: rows,
      autocontour: false,
      contours: {
        ...levels(low, high, contours),
        coloring: "none",
        showlabels: true,
        labelfont: { ...font, size: font.size - 2, color: diverging ? colours.ink : ground },
      },
      line: { width: 1, color: lineColour, smoothing: 0.6 },
      showscale: false,
      hoverinfo: "skip",
      connectgaps: false,
    },
  ];
  for (const [state, { symbol }] of Object.entries(CELL_MARKS)) {
    const cells = states.map((s, k) => (s === state && (markAll || values[k] === null) ? k : -1)).filter((k) => k >= 0);
    if (!cells.length) continue;
    traces.push({
      type: "scatter",
      mode: "markers",
      x: cells.map((k) => x.values[k % nx]),
      y: cells.map((k) => y.values[Math.floor(k / nx)]),
      marker: { symbol, size: compact ? 6 : 7, color: colours.inkSoft, line: { width: 1.2, color: colours.inkSoft } },
      showlegend: false,
      hovertemplate: `${place}${words[state]}<extra></extra>`,
    });
  }
  if (current) {
    traces.push({
      type: "scatter",
      mode: "markers",
      x: [current.x],
      y: [current.y],
      showlegend: false,
      hovertemplate: `${words.current}<extra></extra>`,
      marker: { symbol: "circle-cross-open", size: 13, color: colours.cursor, line: { width: 2 } },
    });
  }
  const layout = {
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    font,
    dragmode: false,
    hovermode: "closest",
    showlegend: false,
    margin: { l: 46, r: 8, t: 8, b: 38 },
    hoverlabel: { bgcolor: colours.panel, bordercolor: colours.line, font: { color: colours.ink } },
    xaxis: {
      ...axis,
      title: { text: x.label, standoff: 4, font: { ...font, color: x.colour ?? font.color } },
      range: ends(x.values),
    },
    yaxis: {
      ...axis,
      title: { text: y.label, standoff: 4, font: { ...font, color: y.colour ?? font.color } },
      range: ends(y.values),
    },
  };
  return { traces, layout };
}

/** Axis from half a cell before the first to half a cell after the last. */
function ends(values) {
  const half = values.length > 1 ? (values[1] - values[0]) / 2 : 0.5;
  return [values[0] - half, values.at(-1) + half];
}

/** Limits of the colours: those of the values, or symmetric about 0; [0, 1] while there are no values. */
function limits(known, diverging) {
  if (!known.length) return [0, 1];
  const [low, high] = [Math.min(...known), Math.max(...known)];
  if (!diverging) return low < high ? [low, high] : [low - 1, high + 1];
  const most = Math.max(-low, high) || 1;
  return [-most, most];
}

/** Contours at round numbers: about `count` at most from `low` to `high`. */
function levels(low, high, count) {
  const least = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(least));
  const size = power * [1, 2, 5, 10].find((step) => step * power >= least * (1 - 1e-9));
  return { start: Math.ceil(low / size) * size, end: Math.floor(high / size) * size, size };
}

/** A map to click: follows the signals that `map()` reads; calls `onPick(xValue, yValue)`. */
export function ActivationMap({ name, label, title, heading, map, words, onPick }) {
  const figure = () => activationMapFigure(map(), palette.value, words, narrow.value);
  return html`
    <${PlotlyPlace}
      name=${name}
      label=${label}
      title=${title}
      heading=${heading}
      figure=${figure}
      onPick=${({ x, y }) => onPick(x, y)}
    />
  `;
}

/** Names and counts of the cells without a value; other `states` are ignored. */
export function CellLegend({ states, words, counted }) {
  const present = Object.entries(CELL_MARKS).map(([state, { sign }]) => [
    state,
    sign,
    states.filter((s) => s === state).length,
  ]);
  return html`
    <ul class="cell-legend">
      ${present
        .filter(([, , n]) => n)
        .map(
          ([state, sign, n]) => html`
            <li key=${state} data-state=${state}>
              <b aria-hidden="true">${sign}</b>
              ${" "}${counted(words[state], n)}
            </li>
          `,
        )}
    </ul>
  `;
}
