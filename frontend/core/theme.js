/** Light or dark, and the colours and fonts of the style sheet for what is painted on a canvas. */
import { computed, signal } from "./ui.js";

const THEME_KEY = "vocalis.theme";

const system = matchMedia("(prefers-color-scheme: dark)");

const _chosenTheme = signal(localStorage.getItem(THEME_KEY) ?? "system"); // system | light | dark

const _systemDark = signal(system.matches);

system.addEventListener("change", (event) => (_systemDark.value = event.matches));

export const theme = computed(() =>
  _chosenTheme.value === "system" ? (_systemDark.value ? "dark" : "light") : _chosenTheme.value,
);

export function toggleTheme() {
  _chosenTheme.value = theme.value === "dark" ? "light" : "dark";
  localStorage.setItem(THEME_KEY, _chosenTheme.value);
}

const NAMES = {
  ink: "--ink",
  inkSoft: "--ink-soft",
  grid: "--grid",
  panel: "--panel",
  line: "--line",
  accent: "--accent",
  fold: "--tissue-fold",
  lip: "--tissue-lip",
  wall: "--tissue-wall",
  cartilage: "--cartilage",
  cartilageEdge: "--cartilage-edge",
  opening: "--opening",
  openingPale: "--opening-pale",
  glow: "--glow",
  superior: "--edge-superior",
  inferior: "--edge-inferior",
  medial: "--medial",
  ghost: "--ghost",
  ta: "--ta",
  ct: "--ct",
  lca: "--lca",
  ia: "--ia",
  pca: "--pca",
  cycle: "--cycle",
  cursor: "--cursor",
  mostOpen: "--most-open",
  mostClosed: "--most-closed",
  pressure: "--wave-pressure",
  flow: "--wave-flow",
  slope: "--wave-slope",
  area: "--wave-area",
  contact: "--wave-contact",
  voiceA: "--voice-a",
  voiceB: "--voice-b",
};

/**
 * @param {Element} element
 * @returns {Record<keyof typeof NAMES, string>}
 */
function coloursOf(element) {
  const style = getComputedStyle(element);
  const read = Object.entries(NAMES).map(([key, name]) => [key, style.getPropertyValue(name).trim()]);
  return Object.fromEntries(read);
}

/** Colours by name in the present theme. The attribute is set here, so the colours come from the right rules. */
export const palette = computed(() => {
  document.documentElement.dataset.theme = theme.value;
  return { ...coloursOf(document.documentElement), theme: theme.value };
});

/** The light colours in any theme, for printing on white. They are read from an element of class "on-white". */
export function paperPalette() {
  const place = document.createElement("i");
  place.className = "on-white";
  document.body.append(place);
  const colours = coloursOf(place);
  place.remove();
  return { ...colours, theme: "light" };
}

/** One rem in pixels: the page's own unit, which grows with the screen. */
export const rootPx = () => parseFloat(getComputedStyle(document.documentElement).fontSize);

/** The fonts of the page, on one line. */
export const fontFamily = () =>
  getComputedStyle(document.documentElement).getPropertyValue("--font").trim().replace(/\s+/g, " ");

/** Canvas text in the page's own small size, which grows with the screen. */
export function smallFont(weight = 400, rem = rootPx()) {
  return `${weight} ${(rem * 0.78).toFixed(2)}px ${fontFamily()}`;
}
