/** A and B to hear: one of them, or both in turn, at equal loudness, in place of the live voice. */
import { effect } from "../ui.js";
import { heard, held, second, stopHearing } from "../state/compare.js";
import { playing, setPlaying } from "../state/sound.js";
import { equalGains } from "./loudness.js";
import { loopOf, openVoice } from "./sound.js";

const TURN_MS = 1400;

/** Starts following what is to be heard; returns the end of it. */
export function followAudition() {
  let turning = 0;
  const ends = [
    effect(() => {
      clearInterval(turning);
      const which = heard.value;
      if (!which || !held.value.a || !second.value) return;
      const voice = openVoice();
      const rate = voice.context.sampleRate;
      const loops = [held.value.a.result, second.value.result].map((shown) => loopOf(shown, rate));
      const gains = equalGains(loops, rate);
      const sound = (k) => voice.play(loops[k] && loops[k].map((v) => v * gains[k]));
      let now = which === "b" ? 1 : 0;
      sound(now);
      if (which === "turn") turning = setInterval(() => sound((now = 1 - now)), TURN_MS);
    }),
    effect(() => {
      // Listening to the live voice again ends the comparison, and so does silence.
      if (!playing.value) stopHearing();
    }),
    effect(() => void (heard.value && setPlaying(true))),
  ];
  return () => {
    clearInterval(turning);
    ends.forEach((end) => end());
  };
}
