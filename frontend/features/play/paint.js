/** Paints the played voice: scrolling waves, the trace of pitch and level, the spectrum, and the CT–TA pad. */
import { fewTicks, numberText, tickText } from "../../core/axis.js";

const LINE_REM = 0.8; // one line of small print

/** A frame for one line, with its scale at the left: {left, right, x(share), y(value)}. */
function frame(context, box, { top, bottom, low, high, title, unit }, colours, font, rem) {
  const left = 3.1 * rem;
  const right = box.width - 0.5 * rem;
  const y = (value) => bottom - ((value - low) / (high - low)) * (bottom - top);
  context.font = font;
  context.textBaseline = "middle";
  context.textAlign = "right";
  const marks = fewTicks(low, high);
  const written = Math.ceil((LINE_REM * rem) / Math.abs(y(marks[1]) - y(marks[0]))); // label every n-th tick
  marks.forEach((mark, k) => {
    context.fillStyle = colours.grid;
    context.fillRect(left, Math.round(y(mark)), right - left, 0.75);
    context.fillStyle = colours.inkSoft;
    if (k % written === 0) context.fillText(tickText(mark, marks[1] - marks[0]), left - 5, y(mark));
  });
  context.textAlign = "left";
  context.fillStyle = colours.ink;
  context.fillText(`${title}${unit ? ` (${unit})` : ""}`, left, top - 0.6 * rem);
  return { left, right, y, x: (share) => left + share * (right - left) };
}

function polyline(context, points, colour) {
  context.beginPath();
  let drawing = false;
  for (const [x, y] of points) {
    if (!Number.isFinite(y)) drawing = false;
    else if (drawing) context.lineTo(x, y);
    else {
      context.moveTo(x, y);
      drawing = true;
    }
  }
  context.lineWidth = 1.5;
  context.lineJoin = "bevel";
  context.strokeStyle = colour;
  context.stroke();
}

/** Area and flow of the last half second, newest at the right. `limits`: one [0, high] per row. */
export function drawScroll(context, box, { scroll, limits, texts, colours, font, rem }) {
  const rows = [
    { values: scroll.area, colour: colours.area, title: texts.area, unit: "mm²" },
    { values: scroll.flow, colour: colours.flow, title: texts.flow, unit: "mL/s" },
  ];
  const each = box.height / rows.length;
  rows.forEach((row, k) => {
    const place = frame(
      context,
      box,
      { top: k * each + 1.3 * rem, bottom: (k + 1) * each - 0.4 * rem, low: 0, high: limits[k][1], ...row },
      colours,
      font,
      rem,
    );
    const most = Math.round(scroll.seconds * scroll.rate);
    const skipped = most - row.values.length;
    polyline(
      context,
      row.values.map((value, i) => [place.x((skipped + i) / most), place.y(value)]),
      row.colour,
    );
  });
}

/** Pitch and level of the last seconds, with gaps where there is no voice. */
export function drawTrace(context, box, { trace, seconds, limits, texts, colours, font, rem }) {
  const end = trace.length ? trace[trace.length - 1].timeS : 0;
  const rows = [
    { key: "fo", colour: colours.pressure, title: texts.fo, unit: "Hz" },
    { key: "level", colour: colours.contact, title: texts.level, unit: "dB" },
  ];
  const each = box.height / rows.length;
  rows.forEach((row, k) => {
    const [low, high] = limits[k];
    const place = frame(
      context,
      box,
      { top: k * each + 1.3 * rem, bottom: (k + 1) * each - 0.4 * rem, low, high, ...row },
      colours,
      font,
      rem,
    );
    polyline(
      context,
      trace.map((at) => [place.x(1 - (end - at.timeS) / seconds), at[row.key] === null ? NaN : place.y(at[row.key])]),
      row.colour,
    );
  });
}

const SPECTRUM_HZ = 5000;
const SPECTRUM_DB = [-100, -20];

/** The spectrum of the sound, 0 to 5 kHz; `bins` in dB, `hzPerBin`. */
export function drawSpectrum(context, box, { bins, hzPerBin, texts, colours, font, rem }) {
  const [low, high] = SPECTRUM_DB;
  const place = frame(
    context,
    box,
    { top: 1.3 * rem, bottom: box.height - 1.3 * rem, low, high, title: texts.spectrum, unit: "dB" },
    colours,
    font,
    rem,
  );
  context.textAlign = "center";
  context.textBaseline = "top";
  context.fillStyle = colours.inkSoft;
  for (let kHz = 0; kHz <= SPECTRUM_HZ / 1000; kHz++)
    context.fillText(
      `${kHz}${kHz === 5 ? " kHz" : ""}`,
      Math.min(place.x((kHz * 1000) / SPECTRUM_HZ), box.width - 1.2 * rem),
      box.height - 1.1 * rem,
    );
  const count = Math.min(bins.length, Math.ceil(SPECTRUM_HZ / hzPerBin));
  polyline(
    context,
    Array.from({ length: count }, (_, k) => [
      place.x((k * hzPerBin) / SPECTRUM_HZ),
      place.y(Math.max(low, Math.min(high, bins[k]))),
    ]),
    colours.pressure,
  );
}

/** The place of the pad: {left, top, width, height, toPoint(ct, ta), fromPoint(x, y)}; CT to the right, TA up. */
export function padLayout(box, rem) {
  const left = 2.4 * rem;
  const top = 0.5 * rem;
  const width = box.width - left - 0.8 * rem;
  const height = box.height - top - 2.2 * rem;
  const within = (share) => Math.max(0, Math.min(1, share));
  return {
    left,
    top,
    width,
    height,
    toPoint: (ct, ta) => [left + ct * width, top + (1 - ta) * height],
    fromPoint: (x, y) => ({ ct: within((x - left) / width), ta: within(1 - (y - top) / height) }),
  };
}

/** The pad: the map of pitch, if there is one, and the present point. */
export function drawPad(context, box, { ct, ta, map, fo, texts, colours, font, rem }) {
  const place = padLayout(box, rem);
  if (map) drawMap(context, place, map, colours);
  context.strokeStyle = colours.line;
  context.lineWidth = 1;
  context.strokeRect(place.left, place.top, place.width, place.height);
  context.font = font;
  context.fillStyle = colours.inkSoft;
  context.textBaseline = "top";
  context.textAlign = "center";
  for (const mark of [0, 0.5, 1])
    context.fillText(String(mark), place.left + mark * place.width, place.top + place.height + 0.3 * rem);
  context.fillStyle = colours.ct;
  context.fillText(texts.ct, place.left + place.width / 2, place.top + place.height + 1.1 * rem);
  context.save();
  context.translate(0.6 * rem, place.top + place.height / 2);
  context.rotate(-Math.PI / 2);
  context.fillStyle = colours.ta;
  context.fillText(texts.ta, 0, -0.4 * rem);
  context.restore();
  context.fillStyle = colours.inkSoft;
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const mark of [0, 0.5, 1]) context.fillText(String(mark), place.left - 5, place.top + (1 - mark) * place.height);
  drawPoint(context, place.toPoint(ct, ta), fo, colours, font, rem);
}

function drawPoint(context, place, fo, colours, font, rem) {
  const [x, y] = place;
  context.beginPath();
  context.arc(x, y, 0.55 * rem, 0, 2 * Math.PI);
  context.fillStyle = colours.accent;
  context.fill();
  context.lineWidth = 2;
  context.strokeStyle = colours.panel;
  context.stroke();
  if (fo === null || fo === undefined) return;
  context.font = font;
  context.textBaseline = "middle";
  const right = x > 5 * rem;
  context.textAlign = right ? "right" : "left";
  context.lineWidth = 3;
  const text = `${numberText(fo, 0)} Hz`;
  const at = x + (right ? -1 : 1) * 0.9 * rem;
  context.strokeText(text, at, y);
  context.fillStyle = colours.ink;
  context.fillText(text, at, y);
}

/** Cells of f_o in Hz, light to dark; cells without a value stay empty. `map`: {ct, ta, fo (ct outermost)}. */
function drawMap(context, place, { ct, ta, fo }, colours) {
  const values = fo.filter((value) => value !== null);
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const dx = place.width / (ct.length - 1);
  const dy = place.height / (ta.length - 1);
  context.save();
  context.beginPath();
  context.rect(place.left, place.top, place.width, place.height);
  context.clip();
  for (let i = 0; i < ct.length; i++) {
    for (let j = 0; j < ta.length; j++) {
      const value = fo[i * ta.length + j];
      if (value === null) continue;
      const [x, y] = place.toPoint(ct[i], ta[j]);
      // Whole pixels: overlaps or gaps of a part of a pixel would show as a grid.
      const [left, right, top, bottom] = [x - dx / 2, x + dx / 2, y - dy / 2, y + dy / 2].map(Math.round);
      context.globalAlpha = 0.06 + 0.5 * ((value - low) / (high - low || 1));
      context.fillStyle = colours.pressure;
      context.fillRect(left, top, right - left, bottom - top);
    }
  }
  context.restore();
}
