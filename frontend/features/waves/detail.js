/** The whole run, to zoom into and to measure. */
import { html, useEffect, useRef, useState } from "../../core/ui.js";
import { Dialog } from "../../core/dialog.js";
import { loadPlotly } from "../../core/plotly.js";
import { fontFamily, palette } from "../../core/theme.js";
import { result } from "../../state/answers.js";
import { narrow } from "../../state/look.js";
import { ROWS, slope } from "./stack.js";
import { DETAIL, WAVES } from "./texts.js";

// Listed one by one: the library's default list has a button that uploads the data.
const BUTTONS = ["toImage", "zoom2d", "pan2d", "zoomIn2d", "zoomOut2d", "resetScale2d"];
const CONFIG = { displaylogo: false, responsive: true, modeBarButtons: [BUTTONS] };

export function Detail() {
  const place = useRef(null);
  const [note, setNote] = useState(DETAIL.loading);
  useEffect(() => {
    const element = place.current;
    let plotly = null;
    let gone = false;
    loadPlotly().then(
      (loaded) => {
        if (gone) return;
        plotly = loaded;
        setNote("");
        const { traces, layout } = figureOf(result.peek(), palette.peek());
        plotly.newPlot(element, traces, layout, CONFIG);
      },
      () => setNote(DETAIL.failed),
    );
    return () => {
      gone = true;
      plotly?.purge(element);
    };
  }, []);
  return html`
    <${Dialog} title=${result.peek().startS > 0 ? DETAIL.titleOfEnd : DETAIL.title} wide=${true}>
      <p role="status">${note}</p>
      <div class="plotly-place" ref=${place}></div>
    <//>
  `;
}

function figureOf(shown, colours) {
  const samples = shown.waves.flow.length;
  const times = Float64Array.from({ length: samples }, (_, k) => shown.startS + k / shown.rate);
  const rows = ROWS.map((row) => {
    const wave = row.key === "slope" ? slope(shown.waves.flow, 0, samples - 1, shown.rate) : shown.waves[row.key];
    return { label: WAVES[row.key], unit: row.unit, colour: colours[row.key], values: wave.map((v) => v * row.factor) };
  });
  return stackFigure(rows, times, DETAIL.time, colours, narrow.peek());
}

/** Traces and layout of a stack of waves on one time axis. `narrow`: the buttons need a line of their own. */
export function stackFigure(rows, timeS, axisTitle, colours, narrow) {
  const count = rows.length;
  const family = fontFamily();
  const font = { family, size: 13, color: colours.ink };
  const axis = { gridcolor: colours.grid, zerolinecolor: colours.line, linecolor: colours.line, automargin: true };
  const layout = {
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    font,
    margin: { l: 64, r: 16, t: narrow ? 64 : 34, b: 44 },
    modebar: { bgcolor: "rgba(0,0,0,0)", color: colours.inkSoft, activecolor: colours.accent },
    annotations: [],
    showlegend: false,
    hovermode: "x unified",
    hoverlabel: { bgcolor: colours.panel, bordercolor: colours.line, font: { color: colours.ink } },
    dragmode: "zoom",
    xaxis: { ...axis, title: { text: axisTitle, font }, anchor: `y${count}`, hoverformat: ".5f" },
  };
  const traces = rows.map((row, k) => {
    const name = k === 0 ? "y" : `y${k + 1}`;
    const top = 1 - k / count;
    layout[k === 0 ? "yaxis" : `yaxis${k + 1}`] = {
      ...axis,
      title: { text: row.unit, font },
      domain: [top - 0.8 / count, top - 0.06 / count],
      nticks: 4,
      tickformat: "~g",
    };
    layout.annotations.push({
      text: `<b>${row.label}</b>`,
      x: 0,
      xref: "paper",
      xanchor: "left",
      y: top - 0.05 / count,
      yref: "paper",
      yanchor: "bottom",
      showarrow: false,
      font,
    });
    return {
      x: timeS,
      y: row.values,
      yaxis: name,
      xaxis: "x",
      type: "scatter",
      mode: "lines",
      name: row.label,
      line: { width: 1.3, color: row.colour },
      hovertemplate: `%{y:.4~g} ${row.unit}`,
    };
  });
  return { traces, layout };
}
