/**
 * Measures the time from an input to the picture. For every change: the time until the first painted frame that shows
 * it or a later change; while the voice is played, also the time until the first sound that follows it leaves the
 * loudspeaker. Read with performance.getEntriesByName("slider to shape" | "slider to all" | "slider to sound").
 */

const MOST = 400;
const inputs = new Map(); // version → time
const shownUpTo = { "slider to shape": 0, "slider to all": 0, "slider to sound": 0 };

export function recordInput(version) {
  if (!inputs.has(version)) inputs.set(version, performance.now());
  if (inputs.size > MOST) inputs.delete(inputs.keys().next().value);
}

export function recordShown(name, version, end = performance.now()) {
  if (performance.getEntriesByName(name).length > MOST) performance.clearMeasures(name);
  for (const [changed, start] of inputs) {
    if (changed > shownUpTo[name] && changed <= version) performance.measure(name, { start, end });
  }
  shownUpTo[name] = Math.max(shownUpTo[name], version);
}

/** Ignore the changes so far under this name: nothing could show them yet. */
export function waitFrom(name, version) {
  shownUpTo[name] = Math.max(shownUpTo[name], version);
}
