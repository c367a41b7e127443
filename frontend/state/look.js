/** How the page looks, not what it computes: theme, orientation of the stage, which panel is open. */
import { computed, signal } from "../ui.js";
import { readonly } from "./readonly.js";

const THEME_KEY = "vocalis.theme";
const system = matchMedia("(prefers-color-scheme: dark)");
const small = matchMedia("screen and (max-width: 1099px)");

const _chosenTheme = signal(localStorage.getItem(THEME_KEY) ?? "system"); // system | light | dark
const _systemDark = signal(system.matches);
const _narrow = signal(small.matches);
const _orientation = signal("anterior_left"); // anterior_left | endoscope
const _muscles = signal(true);
const atMap = new URLSearchParams(location.search).has("map");
const _panel = signal(atMap ? "map" : "waves"); // desktop, right column: a key of PANELS
const _tab = signal(atMap ? "map" : "muscles"); // phone: a key of TABS
const _open = signal(null); // null or {name, ...}: the dialog on top

system.addEventListener("change", (event) => (_systemDark.value = event.matches));
small.addEventListener("change", (event) => (_narrow.value = event.matches));

export const theme = computed(() =>
  _chosenTheme.value === "system" ? (_systemDark.value ? "dark" : "light") : _chosenTheme.value,
);
/** Whether the page is laid out for a phone or tablet. */
export const narrow = readonly(_narrow);
export const orientation = readonly(_orientation);
export const musclesShown = readonly(_muscles);
export const panel = readonly(_panel);
export const tab = readonly(_tab);
export const open = readonly(_open);
/** Whether the map over two parameters is shown. */
export const mapShown = computed(() => (_narrow.value ? _tab : _panel).value === "map");

export function toggleTheme() {
  _chosenTheme.value = theme.value === "dark" ? "light" : "dark";
  localStorage.setItem(THEME_KEY, _chosenTheme.value);
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

/** The tab a panel stands under on a phone; the others stand under "waves". */
const TAB_OF_PANEL = { measures: "numbers", map: "map", play: "play", lessons: "more", run: "more" };

/** Show a panel, on a phone with the tab it stands under. */
export function showPanel(name) {
  _panel.value = name;
  if (_narrow.peek()) _tab.value = TAB_OF_PANEL[name] ?? "waves";
}

export function setTab(name) {
  _tab.value = name;
}

export function openDialog(name, about = {}) {
  _open.value = { name, ...about };
}

export function closeDialog() {
  _open.value = null;
}
