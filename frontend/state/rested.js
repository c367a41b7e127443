/** The result once the hand rests: what costs more than a frame to draw follows this, and never slows a drag. */
import { effect, signal, untracked } from "../ui.js";
import { result } from "./outcome.js";
import { readonly } from "./readonly.js";
import { version } from "./request.js";

export const REST_MS = 220; // without a change of settings

const _rested = signal(null);

/** The newest result when nothing has been moved for REST_MS, see result.js. */
export const rested = readonly(_rested);

/** Starts following; returns the end of it. */
export function followRest() {
  let waiting = 0;
  let changedAt = -Infinity;
  const take = () => {
    const left = _rested.peek() ? changedAt + REST_MS - performance.now() : 0;
    clearTimeout(waiting);
    if (left <= 0) _rested.value = result.peek();
    else waiting = setTimeout(take, left); // the hand may have moved on since
  };
  const stopHand = effect(() => {
    void version.value;
    changedAt = performance.now();
  });
  const stop = effect(() => {
    if (result.value) untracked(take);
  });
  return () => {
    stop();
    stopHand();
    clearTimeout(waiting);
  };
}
