/** Paints the spectrum, the spectrogram and the tract. */
import { colourWriter } from "../../core/colours.js";
import { drawFrame, fieldIn, strokePoints } from "../../core/plot-frame.js";
import { gainCurve, TOP_HZ } from "./levels.js";

const SHOWN_DB = 80; // below the loudest
export const SPECTROGRAM_DB = 60;

/** `spectrum`: of spectrumOf; `tract` may be null. */
export function drawSpectrum(context, box, { spectrum, tract, colours, top }, unit, font, words) {
  const field = fieldIn(box, unit);
  const axes = {
    x: { limits: [0, TOP_HZ / 1e3], label: words.hertz },
    y: { limits: [top - SHOWN_DB, top], label: words.level },
  };
  const { x, y, inside } = drawFrame(context, field, axes, colours, font);
  inside(() => {
    for (const { frequency_hz: hz } of tract?.formants ?? []) {
      context.fillStyle = colours.mostClosed;
      context.fillRect(x(hz / 1e3) - 0.75, field.top, 1.5, field.bottom - field.top);
    }
    const points = Array.from(spectrum.levelDb, (db, k) => [x(spectrum.frequencyHz[k] / 1e3), y(db)]);
    strokePoints(context, points, colours.pressure, { width: 1.1 });
    if (tract)
      strokePoints(
        context,
        gainCurve(tract, top - 6).map(([hz, db]) => [x(hz / 1e3), y(db)]),
        colours.mostClosed,
        { dash: [4, 3] },
      );
    context.fillStyle = colours.accent;
    for (const { hz, db } of spectrum.harmonics) {
      context.beginPath();
      context.arc(x(hz / 1e3), y(db), 2.6, 0, 2 * Math.PI);
      context.fill();
    }
  });
  context.font = font;
  context.textAlign = "center";
  context.textBaseline = "bottom";
  context.fillStyle = colours.mostClosed;
  (tract?.formants ?? []).forEach(
    ({ frequency_hz: hz }, k) => hz < TOP_HZ && context.fillText(`R${k + 1}`, x(hz / 1e3), field.top - 3),
  );
}

/** Levels over time, one pixel per value, stretched. */
export function drawSpectrogram(context, box, { spectrogram, tract, cycle, colours }, unit, font, words) {
  const field = fieldIn(box, unit);
  const { firstS, lastS, rows, stepHz } = spectrogram;
  const axes = {
    x: { limits: [firstS, lastS], label: words.seconds },
    y: { limits: [0, TOP_HZ / 1e3], label: words.kilohertz },
  };
  const { x, y, inside } = drawFrame(context, field, axes, colours, font);
  inside(() => {
    const height = y(0) - y((rows * stepHz) / 1e3);
    context.drawImage(imageOf(spectrogram, colours.theme), field.left, y(0) - height, field.right - field.left, height);
    for (const { frequency_hz: hz } of tract?.formants ?? []) {
      context.fillStyle = colours.accent;
      context.fillRect(field.right - 9, y(hz / 1e3) - 1, 9, 2);
    }
    context.fillStyle = colours.cursor;
    context.fillRect(
      x(cycle.startS),
      field.top,
      Math.max(1.5, x(cycle.startS + cycle.periodS) - x(cycle.startS)),
      field.bottom - field.top,
    );
  });
}

function imageOf({ columns, rows, levels, topDb }, theme) {
  const canvas = document.createElement("canvas");
  canvas.width = columns;
  canvas.height = rows;
  const context = canvas.getContext("2d");
  const image = context.createImageData(columns, rows);
  const write = colourWriter({ kind: "below", limit: SPECTROGRAM_DB }, theme);
  for (let c = 0; c < columns; c++) {
    for (let k = 0; k < rows; k++) {
      const pixel = 4 * ((rows - 1 - k) * columns + c);
      write(Math.max(0, levels[c * rows + k] - topDb + SPECTROGRAM_DB), image.data, pixel);
      image.data[pixel + 3] = 255;
    }
  }
  context.putImageData(image, 0, 0);
  return canvas;
}

/** The tract as steps of area from the glottis to the lips. */
export function drawTract(context, box, { tract, top, colours }, unit, font, words) {
  const field = fieldIn(box, unit);
  const step = tract.section_length_m * 100;
  const length = step * tract.areas_m2.length;
  const axes = {
    x: { limits: [0, Math.ceil(length)], label: words.along },
    y: { limits: [0, top], label: words.area, most: 3 },
  };
  const { x, y, inside } = drawFrame(context, field, axes, colours, font);
  inside(() => {
    const outline = tract.areas_m2.flatMap((area, k) => [
      [x(k * step), y(area * 1e4)],
      [x((k + 1) * step), y(area * 1e4)],
    ]);
    context.beginPath();
    context.moveTo(x(0), y(0));
    for (const point of outline) context.lineTo(...point);
    context.lineTo(x(length), y(0));
    context.closePath();
    context.fillStyle = colours.openingPale;
    context.fill();
    strokePoints(context, outline, colours.area, { width: 1.6 });
  });
  context.fillStyle = colours.inkSoft;
  context.textBaseline = "bottom";
  context.textAlign = "right";
  context.fillText(words.lips, x(length), field.top - 5);
}
