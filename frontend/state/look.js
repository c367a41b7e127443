/** The layout of the page: orientation of the stage, and which panel, tab or section is shown. */
import { computed, readonly, signal } from "../core/ui.js";

const small = matchMedia("screen and (max-width: 1099px)");

const _narrow = signal(small.matches);
const _orientation = signal("anterior_left"); // anterior_left | endoscope
const _muscles = signal(true);
const atMap = new URLSearchParams(location.search).has("map");
const _panel = signal(atMap ? "map" : "waves"); // desktop, right column: a key of PANELS
const _tab = signal(atMap ? "map" : "muscles"); // phone: a key of TABS

const SECTIONS = ["static", "modal", "maps", "pca", "scoreboard"];
const sectionOfAddress = new URLSearchParams(location.search).get("paper");
const _section = signal(SECTIONS.includes(sectionOfAddress) ? sectionOfAddress : null);

small.addEventListener("change", (event) => (_narrow.value = event.matches));

/** Whether the page is laid out for a phone or tablet. */
export const narrow = readonly(_narrow);
export const orientation = readonly(_orientation);
export const musclesShown = readonly(_muscles);
export const panel = readonly(_panel);
export const tab = readonly(_tab);

/** Whether the map over two parameters is shown. */
export const mapShown = computed(() => (_narrow.value ? _tab : _panel).value === "map");

/** null: the instrument; else one of SECTIONS, the parts of the Paper section. */
export const section = readonly(_section);

export function setSection(name) {
  _section.value = name;
}

export function setOrientation(value) {
  _orientation.value = value;
}

export function setMusclesShown(on) {
  _muscles.value = on;
}

export function setPanel(name) {
  _panel.value = name;
}

/** The tab of a panel on a phone; all others are under "waves". */
const TAB_OF_PANEL = { measures: "numbers", map: "map", play: "play", lessons: "more", run: "more" };

/** Show a panel; on a phone, its tab. */
export function showPanel(name) {
  _panel.value = name;
  if (_narrow.peek()) _tab.value = TAB_OF_PANEL[name] ?? "waves";
}

export function setTab(name) {
  _tab.value = name;
}
