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
    context.textAlign = "center";
    drawTurned(context, words.anterior, 8, box.height / 2, -Math.PI / 2);
    drawTurned(context, words.posterior, box.width - 8, box.height / 2, Math.PI / 2);
  }
}

function drawTurned(context, text, x, y, angle) {
  context.save();
  context.translate(x, y);
  context.rotate(angle);
  context.fillText(text, 0, 0);
  context.restore();
}

/** Abbreviations beside the strands of one side; `names`: {ta: "TA", …}. */
export function drawMuscleNames(context, view, lines, names, colours, font) {
  context.font = font;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineJoin = "round";
  for (const [key, [along, offset]] of Object.entries(NAME_PLACES)) {
    const points = lines[key];
    const [u, r] = points[Math.min(along, points.length - 1)];
    const [x, y] = view.at(u + offset[0], -(r + offset[1]));
    context.lineWidth = 4;
    context.strokeStyle = colours.panel;
    context.strokeText(names[key], x, y);
    context.fillStyle = colours[key];
    context.fillText(names[key], x, y);
  }
}

// Which point of a strand a name stands at, and how far from it, mm.
const NAME_PLACES = { ta: [1, [0, 0.95]], lca: [1, [1.2, 1.1]], pca: [1, [1.3, 2.4]], ia: [0, [1.6, 0]], ct: [1, [-2.1, 0.7]] };

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
