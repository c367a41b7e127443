/** The whole run to zoom into and measure. */
import { html, useEffect, useRef, useState } from "../ui.js";
import { loadPlotly, stackFigure } from "../plots/plotly.js";
import { palette } from "../plots/theme.js";
import { ROWS, slope } from "../plots/waves.js";
import { narrow } from "../state/look.js";
import { result } from "../state/outcome.js";
import { DETAIL, WAVES } from "../texts.js";
import { Dialog } from "./Dialog.js";

// Named one by one: the library's own list has a button that sends the data away.
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
  return html`<${Dialog} title=${result.peek().startS > 0 ? DETAIL.titleOfEnd : DETAIL.title} wide=${true}><p role="status">${note}</p><div class="plotly-place" ref=${place}></div><//>`;
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
