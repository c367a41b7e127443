/** Whether the voice sounds, how loud, and whether it goes on for ever. */
import { signal } from "../ui.js";
import { readonly } from "./readonly.js";

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
