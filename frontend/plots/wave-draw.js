/** Paints the stack of waves. */
import { fewTicks, tickText, ticks } from "./axis.js";

/** Where things stand in a stack of `count` rows: {left, right, rows: [{top, bottom}], x(t)}. */
export function stackLayout(width, height, count, window, unit) {
  const left = 3.1 * unit;
  const right = width - 0.5 * unit;
  const foot = 1.35 * unit;
  const head = 1.25 * unit;
  const each = (height - foot) / count;
  const rows = Array.from({ length: count }, (_, k) => ({ top: k * each + head, bottom: (k + 1) * each - 0.35 * unit }));
  const span = window.endS - window.startS;
  return {
    left, right, rows, width, height, foot,
    x: (timeS) => left + ((timeS - window.startS) / span) * (right - left),
    time: (x) => window.startS + ((x - left) / (right - left)) * span,
  }; // prettier-ignore
}

/** `limits`: one [low, high] a row. */
export function drawWaves(context, layout, result, { window, rows }, limits, colours, font) {
  highlightCycle(context, layout, result, colours);
  drawTimeAxis(context, layout, result, window, colours, font);
  rows.forEach((row, k) => {
    const place = layout.rows[k];
    const [low, high] = limits[k];
    const y = (value) => place.bottom - ((value - low) / (high - low)) * (place.bottom - place.top);
    context.font = font;
    context.textAlign = "right";
    context.textBaseline = "middle";
    const marks = fewTicks(low, high);
    for (const mark of marks) {
      context.fillStyle = colours.grid;
      context.fillRect(layout.left, Math.round(y(mark)), layout.right - layout.left, mark === 0 ? 1.25 : 0.75);
      context.fillStyle = colours.inkSoft;
      context.fillText(tickText(mark, marks[1] - marks[0]), layout.left - 5, y(mark));
    }
    drawLine(context, layout, result, row.values, window, y, colours[row.key]);
  });
}

function drawLine(context, layout, result, values, window, y, colour) {
  const startS = result.startS + window.first / result.rate;
  const pixels = layout.right - layout.left;
  context.save();
  context.beginPath();
  context.rect(layout.left, 0, pixels + 0.5, layout.height);
  context.clip();
  context.beginPath();
  // Two points a pixel are all that can be seen, and what is drawn costs time.
  const stride = Math.max(1, Math.floor(values.length / (2 * pixels)));
  for (let k = 0; k < values.length; k += stride) context.lineTo(layout.x(startS + k / result.rate), y(values[k]));
  context.lineWidth = 1.5;
  context.lineJoin = "bevel";
  context.strokeStyle = colour;
  context.stroke();
  context.restore();
}

function highlightCycle(context, layout, { cycle }, colours) {
  if (!cycle.complete) return;
  const from = layout.x(cycle.startS);
  context.fillStyle = colours.cycle;
  context.fillRect(from, 0, layout.x(cycle.startS + cycle.periodS) - from, layout.height - layout.foot);
}

/** Milliseconds counted from the start of the highlighted cycle. */
function drawTimeAxis(context, layout, { cycle }, window, colours, font) {
  context.font = font;
  context.textAlign = "center";
  context.textBaseline = "top";
  const ms = (timeS) => (timeS - cycle.startS) * 1e3;
  const bottom = layout.height - layout.foot;
  for (const mark of ticks(ms(window.startS), ms(window.endS), 7)) {
    const x = layout.x(cycle.startS + mark / 1e3);
    context.fillStyle = colours.grid;
    context.fillRect(Math.round(x), 0, 0.75, bottom);
    context.fillStyle = colours.inkSoft;
    if (x > layout.left + 8 && x < layout.right - 8) context.fillText(tickText(mark, 5), x, bottom + 4);
  }
}
