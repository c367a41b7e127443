/** Colour maps. Each runs evenly in lightness, so it can be read by colour-blind people and in print. */

const SIZE = 256;

/** Blue through neutral to red-brown: for signed pressure, centred on zero. */
const DIVERGING = {
  light: ["#1c3f77", "#3f78b5", "#93b9da", "#f3f1ec", "#e3ab8b", "#bd5f3c", "#7a2712"],
  dark: ["#a9d3ff", "#5b9bd5", "#2c5c8f", "#1b1f24", "#8c4a31", "#d98059", "#ffd0b5"],
};

/** Neutral to warm: for contact pressure from zero up. */
const SEQUENTIAL = {
  light: ["#f3f1ec", "#f9d9a4", "#f3a95b", "#dc7130", "#a8401c", "#5f1a10"],
  dark: ["#1b1f24", "#57291d", "#97421d", "#d36f22", "#f2a945", "#fdeebc"],
};

/** Neutral to teal: below zero, where contact pulls instead of pushing. */
const BELOW = {
  light: ["#f3f1ec", "#9fc9c2", "#2f7f78"],
  dark: ["#1b1f24", "#2c6a65", "#86cdc3"],
};

const cache = new Map();

/** Uint8 table (256 × 3) of a named map in a theme: diverging | sequential | below. */
export function colourTable(name, theme) {
  const key = `${name} ${theme}`;
  if (!cache.has(key))
    cache.set(key, build({ diverging: DIVERGING, sequential: SEQUENTIAL, below: BELOW }[name][theme]));
  return cache.get(key);
}

function build(stops) {
  const colours = stops.map(fromHex);
  const table = new Uint8Array(SIZE * 3);
  for (let k = 0; k < SIZE; k++) {
    const at = (k / (SIZE - 1)) * (colours.length - 1);
    const i = Math.min(Math.floor(at), colours.length - 2);
    for (let c = 0; c < 3; c++) table[3 * k + c] = colours[i][c] + (at - i) * (colours[i + 1][c] - colours[i][c]);
  }
  return table;
}

const fromHex = (text) => [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16));

/**
 * Writes the colour of `value` into `out` at `at` (red, green, blue). Signed maps ("diverging") take `limit` on both
 * sides; sequential ones run from 0 to `limit` and, in the other hue, down to −`limit`.
 */
export function colourWriter({ kind, limit }, theme) {
  const above = colourTable(kind, theme);
  const below = colourTable("below", theme);
  const top = SIZE - 1;
  return (value, out, at) => {
    const share = kind === "diverging" ? (value / limit + 1) / 2 : Math.abs(value) / limit;
    const table = kind === "sequential" && value < 0 ? below : above;
    const from = 3 * Math.max(0, Math.min(top, Math.round(share * top)));
    out[at] = table[from];
    out[at + 1] = table[from + 1];
    out[at + 2] = table[from + 2];
  };
}

/** The scale between `low` and `limit` as a CSS gradient, from bottom to top. */
export function colourGradient({ kind, limit, low }, theme, stops = 32) {
  const write = colourWriter({ kind, limit }, theme);
  const colour = [0, 0, 0];
  const parts = Array.from({ length: stops + 1 }, (_, k) => {
    write(low + (k / stops) * (limit - low), colour, 0);
    return `rgb(${colour.join(" ")})`;
  });
  return `linear-gradient(to top, ${parts.join(", ")})`;
}

const STOPS = {
  light: ["#c9a227", "#7aa05a", "#2b8a86", "#27608f", "#3a2a6b"],
  dark: ["#6f63c4", "#4d90c9", "#3fb3a8", "#9ec96a", "#f2df7a"],
};

/** CSS colour at `share` 0 to 1 of the series. */
export function rampColour(share, theme) {
  const stops = STOPS[theme].map((text) => [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16)));
  const at = Math.max(0, Math.min(1, share)) * (stops.length - 1);
  const i = Math.min(Math.floor(at), stops.length - 2);
  return `rgb(${stops[i].map((c, k) => Math.round(c + (at - i) * (stops[i + 1][k] - c))).join(" ")})`;
}

/** The same scale in Plotly's form. */
export const rampScale = (theme) => STOPS[theme].map((colour, k) => [k / (STOPS[theme].length - 1), colour]);

/** The colours of signed pressure, centred on 0, in Plotly's form. */
export function divergingScale(theme, stops = 16) {
  const table = colourTable("diverging", theme);
  return Array.from({ length: stops + 1 }, (_, k) => {
    const at = 3 * Math.round((k / stops) * (table.length / 3 - 1));
    return [k / stops, `rgb(${table[at]},${table[at + 1]},${table[at + 2]})`];
  });
}

/** Write `values` (nx·ny, x outermost) into `image` (nx wide, ny high). */
export function fillImage(image, values, scale, theme) {
  const { width: nx, height: ny, data } = image;
  const write = colourWriter(scale, theme);
  for (let i = 0; i < nx; i++) {
    for (let j = 0; j < ny; j++) {
      const pixel = 4 * (j * nx + i);
      write(values[i * ny + j], data, pixel);
      data[pixel + 3] = 255;
    }
  }
  return image;
}

/** Paint onto `canvas`, one pixel per node; the page stretches it smoothly from node to node. */
export function paintField(canvas, { nx, ny }, values, scale, theme) {
  if (canvas.width !== nx || canvas.height !== ny) {
    canvas.width = nx;
    canvas.height = ny;
  }
  const context = canvas.getContext("2d");
  context.putImageData(fillImage(context.createImageData(nx, ny), values, scale, theme), 0, 0);
}
