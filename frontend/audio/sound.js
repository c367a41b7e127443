/** Keeps the sounding voice equal to the result shown. The audio context is made by the first gesture, never before. */
import { effect, untracked } from "../ui.js";
import { isVoiced, measured } from "../result.js";
import { heard } from "../state/compare.js";
import { result } from "../state/outcome.js";
import { looping, playing, setPlaying, volume } from "../state/sound.js";
import { makeLoop, makeOnce } from "./loop.js";
import { Voice } from "./voice.js";

let voice = null;

/** To be called inside a gesture: browsers refuse sound otherwise. */
export function toggleSound() {
  openVoice();
  setPlaying(!playing.value);
}

/** The one sounding voice, made when it is first needed. */
export function openVoice() {
  voice ??= new Voice(new AudioContext({ latencyHint: "interactive" }));
  voice.context.resume();
  return voice;
}

/** Starts following the state; returns the end of it. */
export function followVoice() {
  const ends = [
    effect(() => {
      const level = gainOf(volume.value);
      if (playing.value) voice.setVolume(level);
    }),
    effect(() => {
      if (!playing.value) return voice?.stop();
      if (heard.value) return; // A or B sounds, see audition.js
      if (looping.value) soundOn(result.value);
      else untracked(() => soundOnce(result.value));
    }),
  ];
  return () => {
    ends.forEach((end) => end());
    voice?.context.close();
    voice = null;
  };
}

/** A slider's position to a gain: quiet positions get more room. */
export const gainOf = (position) => 2 * position * position;

function soundOn(shown) {
  voice.play(loopOf(shown, voice.context.sampleRate));
}

function soundOnce(shown) {
  if (!isVoiced(shown)) return setPlaying(false);
  const run = makeOnce(shown.waves.pressure, shown.rate, voice.context.sampleRate);
  voice.play(run, { loop: false, ended: () => !looping.value && setPlaying(false) });
}

/** The loop of a result's voice, Pa; null where nothing sounds. */
export function loopOf(shown, sampleRate) {
  if (!isVoiced(shown)) return null;
  const pitch = measured(shown, "fo_hz");
  const periodS = pitch ? 1 / pitch : shown.cycle.periodS;
  return makeLoop(shown.waves.pressure, shown.rate, { periodS, periodic: shown.state !== "irregular" }, sampleRate);
}
