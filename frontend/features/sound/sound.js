/**
 * Plays the result on the page: whether it sounds, how loud, whether it repeats. The audio context is made after the
 * first click or key, as browsers require.
 */
import { effect, readonly, signal, untracked } from "../../core/ui.js";
import { isVoiced, measured } from "../../core/result.js";
import { result } from "../../state/answers.js";
import { heard } from "../compare/state.js";
import { LoopPlayer } from "./loop-player.js";
import { makeLoop, makeOnce } from "./loop.js";

const _playing = signal(false);
const _volume = signal(0.5);
const _looping = signal(true);

export const playing = readonly(_playing);
/** Position of the volume slider, 0 to 1. */
export const volume = readonly(_volume);
export const looping = readonly(_looping);

export function setPlaying(on) {
  _playing.value = on;
}

export function setVolume(value) {
  _volume.value = value;
}

export function setLooping(on) {
  _looping.value = on;
}

let player = null;

/** Call it from a click or a key: browsers refuse sound otherwise. */
export function toggleSound() {
  openPlayer();
  setPlaying(!playing.value);
}

/** The one player, made when it is first needed. */
export function openPlayer() {
  player ??= new LoopPlayer(new AudioContext({ latencyHint: "interactive" }));
  player.context.resume();
  return player;
}

/** Starts following the state; returns a function that stops it. */
export function followSound() {
  const ends = [
    effect(() => {
      const level = gainOf(volume.value);
      if (playing.value) player.setVolume(level);
    }),
    effect(() => {
      if (!playing.value) return player?.stop();
      if (heard.value) return; // A or B sounds, see audition.js
      if (looping.value) soundOn(result.value);
      else untracked(() => soundOnce(result.value));
    }),
  ];
  return () => {
    ends.forEach((end) => end());
    player?.context.close();
    player = null;
  };
}

/** From the position of a slider to a gain, finer at quiet positions. */
export const gainOf = (position) => 2 * position * position;

function soundOn(shown) {
  player.play(loopOf(shown, player.context.sampleRate));
}

function soundOnce(shown) {
  if (!isVoiced(shown)) return setPlaying(false);
  const run = makeOnce(shown.waves.pressure, shown.rate, player.context.sampleRate);
  player.play(run, { loop: false, ended: () => !looping.value && setPlaying(false) });
}

/** The loop of a result's voice, Pa; null where nothing sounds. */
export function loopOf(shown, sampleRate) {
  if (!isVoiced(shown)) return null;
  const pitch = measured(shown, "fo_hz");
  const periodS = pitch ? 1 / pitch : shown.cycle.periodS;
  return makeLoop(shown.waves.pressure, shown.rate, { periodS, periodic: shown.state !== "irregular" }, sampleRate);
}
