/** A Plotly figure that follows state: `figure()` reads signals and answers {traces, layout}; `onPick(point)` on a click. */
import { effect, html, useEffect, useRef, useState } from "../ui.js";
import { loadPlotly } from "../plots/plotly.js";
import { PAPER } from "../texts-paper.js";

const CONFIG = { displayModeBar: false, responsive: true, scrollZoom: false, doubleClick: false };

export function PlotlyPlace({ name, label, figure, onPick }) {
  const place = useRef(null);
  const [note, setNote] = useState("");
  const pick = useRef(onPick);
  pick.current = onPick;
  useEffect(() => {
    const element = place.current;
    let plotly = null;
    let gone = false;
    let stop = () => {};
    loadPlotly().then(
      (loaded) => {
        if (gone) return;
        plotly = loaded;
        let bound = false;
        stop = effect(() => {
          const { traces, layout } = figure();
          plotly.react(element, traces, layout, CONFIG);
          if (!bound) element.on("plotly_click", ({ points: [point] }) => point && pick.current?.(point));
          bound = true;
        });
      },
      () => setNote(PAPER.plotFailed),
    );
    return () => {
      gone = true;
      stop();
      plotly?.purge(element);
    };
  }, []);
  return html`<div class="plot-place" ref=${place} data-plot=${name} role="img" aria-label=${label}></div>${note && html`<p role="status">${note}</p>`}`;
}
