/** Paints once per frame: several requests to paint the same thing before the next frame become one, the newest. */

const waiting = new Map();
let after = [];
let asked = false;

/** Run `paint` in the next frame; a later call with the same `key` replaces it. */
export function inFrame(key, paint) {
  waiting.set(key, paint);
  ask();
}

export function forget(key) {
  waiting.delete(key);
}

/** Run `report` once the next frame has been painted. */
export function afterPaint(report) {
  after.push(report);
  ask();
}

function ask() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(flush);
}

function flush() {
  asked = false;
  const paints = [...waiting.values()];
  waiting.clear();
  for (const paint of paints) paint();
  if (after.length) {
    const reports = after;
    after = [];
    // A message posted during a frame is delivered after the work of that frame.
    const channel = new MessageChannel();
    channel.port1.onmessage = () => reports.forEach((report) => report());
    channel.port2.postMessage(null);
  }
}
