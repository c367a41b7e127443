/** A field of the medial surface as a picture to export: the map, its ends in words and mm, its colour bar. */
import { niceStep, numberText, ticks, tickText } from "../../core/axis.js";
import { colourWriter, fillImage } from "../../core/colours.js";

const BAR_CELLS = 64;

/** `model`: {fields, values, scale, colours, heading}; `words`: of the ends. */
export function drawField(context, { width, height }, { fields, values, scale, colours, heading }, rem, font, words) {
  const [left, right, top, bottom] = [5 * rem, width - 5 * rem, 1.8 * rem, height - 1.8 * rem];
  const image = document.createElement("canvas");
  [image.width, image.height] = [fields.nx, fields.ny];
  const pixels = image.getContext("2d");
  pixels.putImageData(fillImage(pixels.createImageData(fields.nx, fields.ny), values, scale, colours.theme), 0, 0);
  context.drawImage(image, left, top, right - left, bottom - top);
  context.font = font;
  const write = (text, x, y, align, baseline, colour = colours.inkSoft) => {
    [context.textAlign, context.textBaseline, context.fillStyle] = [align, baseline, colour];
    context.fillText(text, x, y);
  };
  const millimetres = (metres) => `${numberText(metres * 1e3, 1)} mm`;
  write(heading, left, 0.3 * rem, "left", "top", colours.ink);
  write(words.superior, left - 0.4 * rem, top, "right", "top");
  write(millimetres(fields.y.at(-1)), left - 0.4 * rem, (top + bottom) / 2, "right", "middle");
  write(words.inferior, left - 0.4 * rem, bottom, "right", "bottom");
  write(words.anterior, left, bottom + 0.3 * rem, "left", "top");
  write(millimetres(fields.x.at(-1)), (left + right) / 2, bottom + 0.3 * rem, "center", "top");
  write(words.posterior, right, bottom + 0.3 * rem, "right", "top");
  drawBar(context, { left: right + 0.6 * rem, right: right + 1.3 * rem, top, bottom }, scale, colours, write);
}

function drawBar(context, box, scale, colours, write) {
  const { low, limit } = scale;
  const colourAt = colourWriter(scale, colours.theme);
  const rgb = [0, 0, 0];
  const cell = (box.bottom - box.top) / BAR_CELLS;
  for (let k = 0; k < BAR_CELLS; k++) {
    colourAt(low + ((k + 0.5) / BAR_CELLS) * (limit - low), rgb, 0);
    context.fillStyle = `rgb(${rgb.map(Math.round).join(" ")})`;
    context.fillRect(box.left, box.bottom - (k + 1) * cell, box.right - box.left, cell + 0.5);
  }
  const step = niceStep(limit - low, 4);
  for (const mark of ticks(low, limit, 4)) {
    write(
      tickText(mark, step),
      box.right + 5,
      box.bottom - ((mark - low) / (limit - low)) * (box.bottom - box.top),
      "left",
      "middle",
    );
  }
}
