/**
 * Slow motion or strobe: moves the shared phase on while something vibrates, at the rate written on the stage. While the hand
 * moves a control the motion takes fewer steps, so that the frames are there for what the hand does. It rests beside a
 * played voice.
 */
import { effect } from "./ui.js";
import { isVoiced } from "./result.js";
import { result } from "./state/outcome.js";
import { status } from "./state/play.js";
import { version } from "./state/request.js";
import { FLASHES_HZ, moving, phase, pointing, setPhase, slowdown, strobe } from "./state/motion.js";

const HAND_MS = 300; // after its last change the hand counts as moving
const STEP_BESIDE_HAND_MS = 100;

/** Starts the motion; returns the end of it. */
export function followMotion() {
  let handAt = -Infinity;
  let request = 0;
  let before = 0;
  const step = (now) => {
    request = requestAnimationFrame(step);
    if (now - handAt < HAND_MS && now - before < STEP_BESIDE_HAND_MS) return;
    if (strobe.peek() && now - before < 1e3 / FLASHES_HZ) return;
    const elapsed = Math.min(now - before, 100) / 1e3; // a tab that slept does not leap
    before = now;
    const cyclesPerS = strobe.peek() ?? 1 / (slowdown.peek() * result.peek().cycle.periodS);
    setPhase(phase.peek() + elapsed * cyclesPerS);
  };
  const stopHand = effect(() => {
    void version.value;
    handAt = performance.now();
  });
  const stop = effect(() => {
    cancelAnimationFrame(request);
    // A played voice is seen by a strobe of its own, and wants the frames for its sound.
    if (status.value !== "off" || !moving.value || pointing.value || !isVoiced(result.value)) return;
    before = performance.now();
    request = requestAnimationFrame(step);
  });
  return () => {
    stop();
    stopHand();
    cancelAnimationFrame(request);
  };
}
