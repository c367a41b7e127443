/** A measure over one activation as a Plotly figure: line and points; where nothing repeats there is none. Pure. */
export function levelCurveFigure({ x, y, xLabel, yLabel, range, current }, colours) {
  const font = { family: getComputedStyle(document.documentElement).getPropertyValue("--font"), size: 12.5, color: colours.ink };
  const axis = { gridcolor: colours.grid, linecolor: colours.line, zeroline: false, ticks: "outside", tickcolor: colours.line, nticks: 6, fixedrange: true };
  const line = { color: colours.contact, width: 2 };
  return {
    traces: [{ type: "scatter", mode: "lines+markers", x, y, line, marker: { size: 7, color: colours.contact }, connectgaps: false, hovertemplate: `${xLabel} %{x:.3f}<br><b>%{y:.4~g}</b><extra></extra>` }],
    layout: {
      paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)", font, dragmode: false, hovermode: "closest", showlegend: false,
      margin: { l: 54, r: 12, t: 8, b: 42 },
      hoverlabel: { bgcolor: colours.panel, bordercolor: colours.line, font: { color: colours.ink } },
      xaxis: { ...axis, title: { text: xLabel, standoff: 6, font }, range: [-0.02, 1.02] },
      yaxis: { ...axis, title: { text: yLabel, standoff: 6, font }, range },
      shapes: [{ type: "line", xref: "x", yref: "paper", x0: current, x1: current, y0: 0, y1: 1, line: { color: colours.cursor, width: 1, dash: "dot" } }],
    },
  }; // prettier-ignore
}
