/**
 * The result once the user stops moving controls. Pictures that take longer than a frame follow this, so they never
 * slow a drag.
 */
import { effect, readonly, signal, untracked } from "../core/ui.js";
import { result } from "./answers.js";
import { version } from "./request.js";

export const SETTLE_MS = 220; // without a movement

const _settled = signal(null);

/** The newest result once no control has moved for SETTLE_MS, see result.js. */
export const settled = readonly(_settled);

/** Starts following; returns a function that stops it. */
export function followSettled() {
  let waiting = 0;
  let changedAt = -Infinity;
  const take = () => {
    const left = _settled.peek() ? changedAt + SETTLE_MS - performance.now() : 0;
    clearTimeout(waiting);
    if (left <= 0) _settled.value = result.peek();
    else waiting = setTimeout(take, left); // there may have been another movement since
  };
  const stopChanges = effect(() => {
    void version.value;
    changedAt = performance.now();
  });
  const stop = effect(() => {
    if (result.value) untracked(take);
  });
  return () => {
    stop();
    stopChanges();
    clearTimeout(waiting);
  };
}
