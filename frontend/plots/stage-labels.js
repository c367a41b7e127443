/** Words and scale on the stage. */

const BAR_MM = 5;

export function drawWords(context, view, box, words, orientation, colours, font) {
  context.font = font;
  context.fillStyle = colours.inkSoft;
  context.textBaseline = "middle";
  if (orientation === "endoscope") {
    context.textAlign = "center";
    context.fillText(words.anterior, box.width / 2, 12);
    context.fillText(words.posterior, box.width / 2, box.height - 12);
  } else {
    context.textAlign = "left";
    context.fillText(words.anterior, 12, box.height / 2);
    context.textAlign = "right";
    context.fillText(words.posterior, box.width - 12, box.height / 2);
  }
}

/** A bar of 5 mm in the lower right corner. */
export function drawScaleBar(context, view, box, colours, font) {
  const length = BAR_MM * view.scale;
  const x = box.width - 14;
  const y = box.height - 14;
  context.strokeStyle = colours.ink;
  context.lineWidth = 1.5;
  context.lineCap = "butt";
  context.beginPath();
  context.moveTo(x - length, y - 4);
  context.lineTo(x - length, y);
  context.lineTo(x, y);
  context.lineTo(x, y - 4);
  context.stroke();
  context.font = font;
  context.fillStyle = colours.ink;
  context.textAlign = "center";
  context.textBaseline = "bottom";
  context.fillText(`${BAR_MM} mm`, x - length / 2, y - 5);
}
