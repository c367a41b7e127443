/** Announces the new voice to screen readers, once the user stops moving controls. */
import { effect } from "../../core/ui.js";
import { numberText } from "../../core/axis.js";
import { measured } from "../../core/result.js";
import { STATES } from "../../core/texts.js";
import { result } from "../../state/answers.js";
import { announce } from "../../state/session.js";
import { SPEECH } from "./texts.js";

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

/** Starts announcing; returns a function that stops it. */
export function followAnnouncements() {
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
