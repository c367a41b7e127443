/**
 * Moves the shared phase on while the folds vibrate, in slow motion or under a strobe. While the user moves a control
 * the motion takes fewer steps and leaves the frames to the new shapes. It pauses while the voice is played live.
 */
import { effect } from "../../core/ui.js";
import { isVoiced } from "../../core/result.js";
import { result } from "../../state/answers.js";
import { FLASHES_HZ, moving, phase, pointing, setPhase, slowdown, strobe } from "../../state/motion.js";
import { status } from "../../state/played-voice.js";
import { version } from "../../state/request.js";

const MOVEMENT_MS = 300; // a movement ends this long after its last change
const STEP_DURING_MOVEMENT_MS = 100;

/** Starts the motion; returns a function that stops it. */
export function followMotion() {
  let changedAt = -Infinity;
  let request = 0;
  let before = 0;
  const step = (now) => {
    request = requestAnimationFrame(step);
    if (now - changedAt < MOVEMENT_MS && now - before < STEP_DURING_MOVEMENT_MS) return;
    if (strobe.peek() && now - before < 1e3 / FLASHES_HZ) return;
    const elapsed = Math.min(now - before, 100) / 1e3; // a tab that was hidden does not jump
    before = now;
    const cyclesPerS = strobe.peek() ?? 1 / (slowdown.peek() * result.peek().cycle.periodS);
    setPhase(phase.peek() + elapsed * cyclesPerS);
  };
  const stopChanges = effect(() => {
    void version.value;
    changedAt = performance.now();
  });
  const stop = effect(() => {
    cancelAnimationFrame(request);
    // A played voice has its own strobe and needs the frames for its sound.
    if (status.value !== "off" || !moving.value || pointing.value || !isVoiced(result.value)) return;
    before = performance.now();
    request = requestAnimationFrame(step);
  });
  return () => {
    stop();
    stopChanges();
    cancelAnimationFrame(request);
  };
}
