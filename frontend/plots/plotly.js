/** Plotly, fetched from this server when it is first needed. */

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

/** What a Plotly figure shows as a file: SVG text or a PNG blob, on `ground`, under its heading. */
export async function plotlyFile(element, kind, ground, heading) {
  const { clientWidth: width, clientHeight: height } = element;
  const figure = { data: element.data, layout: { ...element.layout, paper_bgcolor: ground, title: { text: heading, font: { size: 14 }, x: 0.02 }, margin: { ...element.layout.margin, t: 40 } } };
  const address = await window.Plotly.toImage(figure, { format: kind, width, height, scale: kind === "png" ? 3 : 1 });
  const content = address.slice(address.indexOf(",") + 1);
  if (kind === "svg") return decodeURIComponent(content);
  return new Blob([Uint8Array.from(atob(content), (sign) => sign.charCodeAt(0))], { type: "image/png" });
}

/** Traces and layout of a stack of waves on one time axis. `narrow`: the buttons need a line of their own. */
export function stackFigure(rows, timeS, axisTitle, colours, narrow) {
  const count = rows.length;
  const family = getComputedStyle(document.documentElement).getPropertyValue("--font");
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
      text: `<b>${row.label}</b>`, x: 0, xref: "paper", xanchor: "left", y: top - 0.05 / count, yref: "paper", yanchor: "bottom", showarrow: false, font,
    }); // prettier-ignore
    return { x: timeS, y: row.values, yaxis: name, xaxis: "x", type: "scatter", mode: "lines", name: row.label, line: { width: 1.3, color: row.colour }, hovertemplate: `%{y:.4~g} ${row.unit}` };
  });
  return { traces, layout };
}
