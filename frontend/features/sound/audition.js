/** Plays A, B, or both in turn at equal loudness, in place of the live voice. */
import { effect } from "../../core/ui.js";
import { powerSpectrum } from "../../core/fft.js";
import { heard, held, second, stopHearing } from "../compare/state.js";
import { loopOf, openPlayer, playing, setPlaying } from "./sound.js";

const TURN_MS = 1400;

/** Starts following the choice of A or B; returns a function that stops it. */
export function followAudition() {
  let turning = 0;
  const ends = [
    effect(() => {
      clearInterval(turning);
      const which = heard.value;
      if (!which || !held.value.a || !second.value) return;
      const voice = openPlayer();
      const rate = voice.context.sampleRate;
      const loops = [held.value.a.result, second.value.result].map((shown) => loopOf(shown, rate));
      const gains = equalGains(loops, rate);
      const sound = (k) => voice.play(loops[k] && loops[k].map((v) => v * gains[k]));
      let now = which === "b" ? 1 : 0;
      sound(now);
      if (which === "turn") turning = setInterval(() => sound((now = 1 - now)), TURN_MS);
    }),
    effect(() => {
      // Silence ends the audition.
      if (!playing.value) stopHearing();
    }),
    effect(() => void (heard.value && setPlaying(true))),
  ];
  return () => {
    clearInterval(turning);
    ends.forEach((end) => end());
  };
}

const SIZE = 8192;

/** A-weighting as a gain, 1 at 1 kHz (IEC 61672-1). */
export function aWeight(hz) {
  const f2 = hz * hz;
  const raw = (w2) =>
    (12194 ** 2 * w2 * w2) / ((w2 + 20.6 ** 2) * Math.sqrt((w2 + 107.7 ** 2) * (w2 + 737.9 ** 2)) * (w2 + 12194 ** 2));
  return raw(f2) / raw(1e6);
}

/** A-weighted rms of a loop, in its own unit. */
export function loudnessOf(loop, rate) {
  const count = Math.min(loop.length, SIZE);
  const power = powerSpectrum(loop, 0, count, SIZE);
  let sum = 0;
  // The bandwidth of the window is the same for both voices and cancels in their ratio.
  for (let k = 1; k < power.length; k++) sum += power[k] * aWeight((k * rate) / SIZE) ** 2;
  return Math.sqrt(sum);
}

/** Gains for two loops that make both as loud as the softer one; null loops stay silent. */
export function equalGains(loops, rate) {
  const levels = loops.map((loop) => (loop ? loudnessOf(loop, rate) : 0));
  const softest = Math.min(...levels.filter((level) => level > 0));
  return levels.map((level) => (level > 0 ? softest / level : 0));
}
