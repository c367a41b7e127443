/** The frame of one plot: two axes with round ticks, labels and units. What is drawn inside is clipped to it. */
import { niceStep, ticks, tickText } from "./axis.js";

/** Place of the field in a picture of `box`, leaving room for the ticks; `unit` is one rem in px. */
export const fieldIn = (box, unit, { left = 2.9, right = 0.7, top = 1.35, bottom = 2.2 } = {}) => ({
  left: left * unit,
  right: box.width - right * unit,
  top: top * unit,
  bottom: box.height - bottom * unit,
});

/**
 * Paint both axes; returns {x(value), y(value), inside(paint)}. `x`, `y`: {limits: [low, high], label, most}, where
 * `most` 0 means no ticks. Labels are at the ends of their axes.
 */
export function drawFrame(context, field, { x, y }, colours, font) {
  const px = (value) => field.left + ((value - x.limits[0]) / (x.limits[1] - x.limits[0])) * (field.right - field.left);
  const py = (value) =>
    field.bottom - ((value - y.limits[0]) / (y.limits[1] - y.limits[0])) * (field.bottom - field.top);
  context.font = font;
  context.textAlign = "right";
  context.textBaseline = "middle";
  const stepY = niceStep(Math.abs(y.limits[1] - y.limits[0]), y.most ?? 4);
  for (const mark of ticks(Math.min(...y.limits), Math.max(...y.limits), y.most ?? 4)) {
    context.fillStyle = colours.grid;
    context.fillRect(field.left, Math.round(py(mark)), field.right - field.left, 0.75);
    context.fillStyle = colours.inkSoft;
    context.fillText(tickText(mark, stepY), field.left - 5, py(mark));
  }
  context.textAlign = "center";
  context.textBaseline = "top";
  const most = x.most ?? 6;
  const stepX = most && niceStep(x.limits[1] - x.limits[0], most);
  for (const mark of most ? ticks(...x.limits, most) : []) {
    context.fillStyle = colours.grid;
    context.fillRect(Math.round(px(mark)), field.top, 0.75, field.bottom - field.top);
    context.fillStyle = colours.inkSoft;
    context.fillText(tickText(mark, stepX), px(mark), field.bottom + 4);
  }
  context.textAlign = "left";
  context.textBaseline = "bottom";
  context.fillText(y.label, Math.max(2, field.left - 30), field.top - (field.left / 2.9) * 0.45);
  context.textAlign = "right";
  context.textBaseline = "bottom";
  context.fillText(x.label, field.right, field.bottom + (field.left / 2.9) * 2.15);
  const inside = (paint) => {
    context.save();
    context.beginPath();
    context.rect(field.left, field.top, field.right - field.left, field.bottom - field.top);
    context.clip();
    paint();
    context.restore();
  };
  return { x: px, y: py, inside };
}

/** A line through [[x, y], …]; gaps where a value is not finite. */
export function strokePoints(context, points, colour, { width = 1.5, dash = [] } = {}) {
  context.beginPath();
  let pen = false;
  for (const [x, y] of points) {
    if (!Number.isFinite(y)) pen = false;
    else if (pen) context.lineTo(x, y);
    else {
      context.moveTo(x, y);
      pen = true;
    }
  }
  context.setLineDash(dash);
  context.lineWidth = width;
  context.lineJoin = "bevel";
  context.strokeStyle = colour;
  context.stroke();
  context.setLineDash([]);
}
