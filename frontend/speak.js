/** Tells screen readers what became of the voice, once the hand rests. */
import { effect } from "./ui.js";
import { numberText } from "./plots/axis.js";
import { measured } from "./result.js";
import { result } from "./state/outcome.js";
import { announce } from "./state/session.js";
import { SPEECH, STATES } from "./texts.js";

const REST_MS = 900;

/** One sentence on a result. Pure. */
export function sentenceOf(shown) {
  const parts = [STATES[shown.state]];
  const pitch = measured(shown, "fo_hz");
  const level = measured(shown, "spl_30cm_db");
  if (pitch !== null) parts.push(SPEECH.pitch(numberText(pitch)));
  if (level !== null) parts.push(SPEECH.level(numberText(level)));
  return `${parts.join(", ")}.`;
}

/** Starts speaking; returns the end of it. */
export function followSpeech() {
  let waiting = 0;
  const stop = effect(() => {
    const shown = result.value;
    if (!shown) return;
    clearTimeout(waiting);
    waiting = setTimeout(() => announce(sentenceOf(shown)), REST_MS);
  });
  return () => {
    stop();
    clearTimeout(waiting);
  };
}
