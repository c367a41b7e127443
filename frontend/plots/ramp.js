/** Colours of an ordered series of lines: even in lightness, told from the ground at both ends, safe for all eyes. */
import { colourTable } from "./colours.js";

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

/** The same scale as Plotly takes it. */
export const rampScale = (theme) => STOPS[theme].map((colour, k) => [k / (STOPS[theme].length - 1), colour]);

/** Colours centred on 0, as Plotly takes them: those of signed pressure. */
export function divergingScale(theme, stops = 16) {
  const table = colourTable("diverging", theme);
  return Array.from({ length: stops + 1 }, (_, k) => {
    const at = 3 * Math.round((k / stops) * (table.length / 3 - 1));
    return [k / stops, `rgb(${table[at]},${table[at + 1]},${table[at + 2]})`];
  });
}
