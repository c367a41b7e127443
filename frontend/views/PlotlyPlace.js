/**
 * A Plotly figure that follows state: `figure()` reads signals and answers {traces, layout}; `onPick(point)` on a click.
 * Among what can be kept it is called `title`, and the file has it under `heading`.
 */
import { effect, html, useEffect, useRef, useState } from "../ui.js";
import { offer } from "../plots/figures.js";
import { loadPlotly, plotlyFile } from "../plots/plotly.js";
import { palette } from "../plots/theme.js";
import { PAPER } from "../texts.js";

const CONFIG = { displayModeBar: false, responsive: true, scrollZoom: false, doubleClick: false };

export function PlotlyPlace({ name, label, title = label, heading = label, figure, onPick }) {
  const place = useRef(null);
  const [note, setNote] = useState("");
  const pick = useRef(onPick);
  pick.current = onPick;
  const latest = useRef(heading);
  latest.current = heading;
  useEffect(() => {
    const element = place.current;
    let plotly = null;
    let gone = false;
    let stop = () => {};
    let withdraw = () => {};
    loadPlotly().then(
      (loaded) => {
        if (gone) return;
        plotly = loaded;
        let bound = false;
        withdraw = offer({ name, title, make: (kind) => plotlyFile(element, kind, palette.peek().panel, latest.current) });
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
      withdraw();
      plotly?.purge(element);
    };
  }, []);
  return html`<div class="plot-place" ref=${place} data-plot=${name} role="img" aria-label=${label}></div>${note && html`<p role="status">${note}</p>`}`;
}
