/** Plotly, loaded from this server when it is first needed, and a figure of it that follows state. */
import { effect, html, useEffect, useRef, useState } from "./ui.js";
import { offer } from "./export.js";
import { palette } from "./theme.js";
import { PLOT } from "./texts.js";

let loading = null;

export function loadPlotly() {
  loading ??= new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = new URL("vendor/plotly.min.js", document.baseURI).href;
    script.onload = () => resolve(window.Plotly);
    script.onerror = () => {
      loading = null;
      reject(new Error("no plot library"));
    };
    document.head.append(script);
  });
  return loading;
}

/** A Plotly figure as a file: SVG text or a PNG blob, on `ground`, under its heading. */
export async function plotlyFile(element, kind, ground, heading) {
  const { clientWidth: width, clientHeight: height } = element;
  const figure = {
    data: element.data,
    layout: {
      ...element.layout,
      paper_bgcolor: ground,
      title: { text: heading, font: { size: 14 }, x: 0.02 },
      margin: { ...element.layout.margin, t: 40 },
    },
  };
  const address = await window.Plotly.toImage(figure, { format: kind, width, height, scale: kind === "png" ? 3 : 1 });
  const content = address.slice(address.indexOf(",") + 1);
  if (kind === "svg") return decodeURIComponent(content);
  return new Blob([Uint8Array.from(atob(content), (sign) => sign.charCodeAt(0))], { type: "image/png" });
}

const CONFIG = { displayModeBar: false, responsive: true, scrollZoom: false, doubleClick: false };

/**
 * `figure()` reads signals and returns {traces, layout}; a click calls `onPick(point)`. In the list of exports the
 * figure has the name `title`; its file has the heading `heading`.
 */
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
        withdraw = offer({
          name,
          title,
          make: (kind) => plotlyFile(element, kind, palette.peek().panel, latest.current),
        });
        stop = effect(() => {
          const { traces, layout } = figure();
          plotly.react(element, traces, layout, CONFIG);
          if (!bound) element.on("plotly_click", ({ points: [point] }) => point && pick.current?.(point));
          bound = true;
        });
      },
      () => setNote(PLOT.failed),
    );
    return () => {
      gone = true;
      stop();
      withdraw();
      plotly?.purge(element);
    };
  }, []);
  return html`
    <div class="plot-place" ref=${place} data-plot=${name} role="img" aria-label=${label}></div>
    ${
      note &&
      html`
        <p role="status">${note}</p>
      `
    }
  `;
}
