/** The phase of the cycle that stage, maps and waves show: at rest, in slow motion, or under a strobe. */
import { readonly, signal } from "../core/ui.js";

export const RATES = [25, 50, 100, 200, 400];

/** Images a second of the stroboscope, and how many visible cycles a second it can be set to show. */
export const FLASHES_HZ = 25;
export const STROBES = [0.5, 1, 2];

const READOUT_MS = 120; // numbers that change faster cannot be read

const _phase = signal(0.3);
const _readout = signal(0.3);
const _moving = signal(!matchMedia("(prefers-reduced-motion: reduce)").matches);
const _pointing = signal(false);
const _slowdown = signal(100);
const _strobe = signal(null);

/** 0 to 1 of the cycle shown. */
export const phase = readonly(_phase);
/** The same for words and numbers, which follow the motion at reading speed. */
export const readout = readonly(_readout);
export const moving = readonly(_moving);
/** A pointer rests on the waves: the motion waits for it to leave. */
export const pointing = readonly(_pointing);
/** Shown at one over this speed. */
export const slowdown = readonly(_slowdown);
/** Visible cycles a second of the stroboscope, locked to f_o; null: slow motion instead. */
export const strobe = readonly(_strobe);

let readAt = 0;

/** Move on within the motion. */
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

/** Look at one phase: the motion stops there. */
export function holdPhase(value) {
  _moving.value = false;
  lookAt(value);
}

/** Look at one phase for as long as the pointer is there. */
export function pointAt(value) {
  _pointing.value = true;
  lookAt(value);
}

export function stopPointing() {
  _pointing.value = false;
}

/** Where the motion stops, words and numbers are those of the picture. */
export function setMoving(on) {
  _moving.value = on;
  if (!on) _readout.value = _phase.value;
}

export function setSlowdown(value) {
  _strobe.value = null;
  _slowdown.value = value;
}

/** Light the folds in flashes, each a little later in the cycle, so that `hz` cycles a second are seen at any pitch. */
export function setStrobe(hz) {
  _strobe.value = hz;
}
