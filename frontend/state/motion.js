/** The phase of the cycle that stage, maps and waves show: at rest, in slow motion, or under a strobe. */
import { readonly, signal } from "../core/ui.js";

export const RATES = [25, 50, 100, 200, 400];

/** Flashes per second of the strobe, and its choices of visible cycles per second. */
export const FLASHES_HZ = 25;
export const STROBES = [0.5, 1, 2];

const READOUT_MS = 120; // numbers that change faster cannot be read

const _phase = signal(0.3);
const _readout = signal(0.3);
const _moving = signal(!matchMedia("(prefers-reduced-motion: reduce)").matches);
const _pointing = signal(false);
const _slowdown = signal(100);
const _strobe = signal(null);

/** The phase on display, 0 to 1. */
export const phase = readonly(_phase);
/** The same for texts and numbers, which follow the motion at reading speed. */
export const readout = readonly(_readout);
export const moving = readonly(_moving);
/** A pointer is over the waves: the motion waits until it leaves. */
export const pointing = readonly(_pointing);
/** The motion is slower by this factor. */
export const slowdown = readonly(_slowdown);
/** Visible cycles per second of the strobe, locked to f_o; null: slow motion. */
export const strobe = readonly(_strobe);

let readAt = 0;

/** Set the phase during the motion. */
export function setPhase(value) {
  _phase.value = value - Math.floor(value);
  if (performance.now() - readAt < READOUT_MS) return;
  readAt = performance.now();
  _readout.value = _phase.value;
}

function lookAt(value) {
  setPhase(value);
  _readout.value = _phase.value;
}

/** Show one phase and stop the motion there. */
export function holdPhase(value) {
  _moving.value = false;
  lookAt(value);
}

/** Show one phase while the pointer is there. */
export function pointAt(value) {
  _pointing.value = true;
  lookAt(value);
}

export function stopPointing() {
  _pointing.value = false;
}

/** When the motion stops, texts and numbers agree with the picture. */
export function setMoving(on) {
  _moving.value = on;
  if (!on) _readout.value = _phase.value;
}

export function setSlowdown(value) {
  _strobe.value = null;
  _slowdown.value = value;
}

/** Light the folds in flashes, each a little later in the cycle: `hz` visible cycles per second at any pitch. */
export function setStrobe(hz) {
  _strobe.value = hz;
}
