/** Two voices to compare: A and B, each held, or B the live one. */
import { batch, computed, readonly, signal } from "../../core/ui.js";
import { result } from "../../state/answers.js";
import { patch } from "../../state/request.js";

const NONE = { a: null, b: null };
const _held = signal(NONE);
const _heard = signal(null); // null | a | b | turn

/** {a, b}: {patch, result} as they were when held, or null. */
export const held = readonly(_held);
/** The voice that sounds instead of the live one: a, b, both in turn, or null. */
export const heard = readonly(_heard);
/** The second of the pair: the held B, else the live voice. */
export const second = computed(() => _held.value.b ?? (result.value && { patch: patch.value, result: result.value }));

/** Hold the present voice as "a" or "b"; false while there is none. */
export function hold(side) {
  if (!result.peek()) return false;
  _held.value = { ..._held.peek(), [side]: { patch: patch.peek(), result: result.peek() } };
  return true;
}

/** Make B live again, or forget both. */
export function release(side) {
  batch(() => {
    _held.value = side === "b" ? { ..._held.peek(), b: null } : NONE;
    if (side !== "b") _heard.value = null;
  });
}

export function hear(which) {
  _heard.value = _heard.peek() === which ? null : which;
}

export function stopHearing() {
  _heard.value = null;
}

const _mode = signal("both"); // both | difference | folds

/** Whether the comparison shows waves overlaid, waves subtracted, or the folds next to each other. */
export const compareMode = readonly(_mode);

export function setCompareMode(mode) {
  _mode.value = mode;
}
