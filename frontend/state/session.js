/** The page and its server: starting, ready, asking for a token, or offline; and short messages to the user. */
import { computed, readonly, signal } from "../core/ui.js";

const _connection = signal("starting"); // starting | ready | login | offline
const _health = signal(null);
const _notice = signal("");
const _announcement = signal("");

export const connection = readonly(_connection);
/** Whether calls may be made: the model is ready and the token, where one is needed, was accepted. */
export const entered = computed(() => _connection.value === "ready" || _connection.value === "offline");
export const health = readonly(_health);
/** One visible line that disappears after a few seconds. */
export const notice = readonly(_notice);
/** One line for screen readers. */
export const announcement = readonly(_announcement);

export function setConnection(value) {
  _connection.value = value;
}

export function setHealth(value) {
  _health.value = value;
}

let clearing = 0;

export function showNotice(text, seconds = 6) {
  _notice.value = text;
  clearTimeout(clearing);
  clearing = setTimeout(() => (_notice.value = ""), seconds * 1000);
}

export function announce(text) {
  _announcement.value = text;
}
