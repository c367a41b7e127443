/** Slow motion: moves the shared phase on while something vibrates, at the rate written on the stage. */
import { effect } from "./ui.js";
import { isVoiced } from "./result.js";
import { result } from "./state/outcome.js";
import { moving, phase, pointing, setPhase, slowdown } from "./state/motion.js";

/** Starts the motion; returns the end of it. */
export function followMotion() {
  let request = 0;
  let before = 0;
  const step = (now) => {
    const elapsed = Math.min(now - before, 100) / 1e3; // a tab that slept does not leap
    before = now;
    setPhase(phase.peek() + elapsed / slowdown.peek() / result.peek().cycle.periodS);
    request = requestAnimationFrame(step);
  };
  const stop = effect(() => {
    cancelAnimationFrame(request);
    if (!moving.value || pointing.value || !isVoiced(result.value)) return;
    before = performance.now();
    request = requestAnimationFrame(step);
  });
  return () => {
    stop();
    cancelAnimationFrame(request);
  };
}
