/** What the deeper views look at: the level of the kymogram, how A and B are compared. */
import { signal } from "../ui.js";
import { readonly } from "./readonly.js";

const _level = signal(0.5);
const _mode = signal("both"); // both | difference | folds

/** Share of the length, anterior 0. */
export const kymogramLevel = readonly(_level);
/** Whether the compared waves are overlaid or subtracted, or the folds stand side by side. */
export const compareMode = readonly(_mode);

export function setKymogramLevel(level) {
  _level.value = level;
}

export function setCompareMode(mode) {
  _mode.value = mode;
}
