/** The colours of the style sheet, for what is painted on a canvas. */
import { computed } from "../ui.js";
import { theme } from "../state/look.js";

const NAMES = {
  ink: "--ink", inkSoft: "--ink-soft", grid: "--grid", panel: "--panel", line: "--line", accent: "--accent",
  fold: "--tissue-fold", lip: "--tissue-lip", wall: "--tissue-wall", cartilage: "--cartilage",
  cartilageEdge: "--cartilage-edge", opening: "--opening", openingPale: "--opening-pale", glow: "--glow",
  superior: "--edge-superior", inferior: "--edge-inferior", medial: "--medial", ghost: "--ghost",
  ta: "--ta", ct: "--ct", lca: "--lca", ia: "--ia", pca: "--pca",
  cycle: "--cycle", cursor: "--cursor", mostOpen: "--most-open", mostClosed: "--most-closed",
  pressure: "--wave-pressure", flow: "--wave-flow", slope: "--wave-slope", area: "--wave-area",
  contact: "--wave-contact", voiceA: "--voice-a", voiceB: "--voice-b",
}; // prettier-ignore

/** Colours by name in the theme shown. The attribute is set here so that they are read from the right rules. */
export const palette = computed(() => {
  document.documentElement.dataset.theme = theme.value;
  const style = getComputedStyle(document.documentElement);
  const colours = Object.fromEntries(Object.entries(NAMES).map(([key, name]) => [key, style.getPropertyValue(name).trim()]));
  return { ...colours, theme: theme.value };
});

/** The light colours, whatever the page shows: what is printed stands on white. Read off an element of class "on-white". */
export function paperPalette() {
  const place = document.createElement("i");
  place.className = "on-white";
  document.body.append(place);
  const style = getComputedStyle(place);
  const colours = Object.fromEntries(Object.entries(NAMES).map(([key, name]) => [key, style.getPropertyValue(name).trim()]));
  place.remove();
  return { ...colours, theme: "light" };
}

/** One rem in pixels: the page's own unit, which grows with the screen. */
export const rootPx = () => parseFloat(getComputedStyle(document.documentElement).fontSize);

/** Canvas text in the page's own small size, which grows with the screen. */
export function smallFont(weight = 400, rem = rootPx()) {
  const family = getComputedStyle(document.documentElement).getPropertyValue("--font");
  return `${weight} ${(rem * 0.78).toFixed(2)}px ${family}`;
}
