/**
 * The shared cursor over the waves: one line in the highlighted cycle and, where cycles repeat, faint ones at the same
 * phase of the others. One element moves them all, so the motion costs no painting.
 */
import { effect, html, signal, useEffect, useRef } from "../ui.js";
import { Disposal } from "../dispose.js";
import { stackLayout } from "../plots/wave-draw.js";
import { rootPx } from "../plots/theme.js";
import { phaseOf } from "../result.js";
import { holdPhase, phase, pointAt, stopPointing } from "../state/motion.js";
import { result } from "../state/outcome.js";

/** `rows`: the signal of what the waves show. */
export function Cursor({ rows }) {
  const field = useRef(null);
  const lines = useRef(null);
  useEffect(() => follow(field.current, lines.current, rows), []);
  return html`
    <div ref=${field} class="cursor-field" data-picture="cursor" ...${pointing(rows)}>
      <div class="cursor-clip"><div ref=${lines} class="cursor-lines"></div></div>
    </div>
  `;
}

const layoutIn = (element, rows) =>
  stackLayout(element.clientWidth, element.clientHeight, rows.peek().rows.length, rows.peek().window, rootPx());

function follow(field, lines, rows) {
  const disposal = new Disposal();
  const resized = signal(0);
  const observer = new ResizeObserver(() => resized.value++);
  observer.observe(field);
  disposal.add(() => observer.disconnect());
  let period = 0;
  let start = 0;
  const place = () => (lines.style.transform = `translateX(${start + phase.peek() * period}px)`);
  disposal.add(
    effect(() => {
      void resized.value;
      if (!rows.value || field.clientWidth === 0) return;
      const { cycle } = result.peek();
      const layout = layoutIn(field, rows);
      const clip = lines.parentElement.style;
      clip.left = `${layout.left}px`;
      clip.width = `${layout.right - layout.left + 1}px`;
      clip.bottom = `${layout.foot}px`;
      start = layout.x(cycle.startS) - layout.left;
      period = layout.x(cycle.startS + cycle.periodS) - layout.x(cycle.startS);
      const count = cycle.complete ? Math.min(40, Math.ceil(start / period) + 1) : 0;
      const others = Array.from({ length: count }, (_, k) => {
        const line = document.createElement("i");
        line.style.left = `${-(k + 1) * period}px`;
        return line;
      });
      lines.replaceChildren(document.createElement("b"), ...others);
      place();
    }),
  );
  disposal.add(effect(() => (void phase.value, place())));
  return () => disposal.dispose();
}

/** A resting mouse looks at an instant; a press, pen or finger stays there. */
function pointing(rows) {
  const look = (event) => {
    if (!rows.peek()) return;
    const field = event.currentTarget;
    const layout = layoutIn(field, rows);
    const x = event.clientX - field.getBoundingClientRect().left;
    if (x < layout.left || x > layout.right) return stopPointing();
    const at = phaseOf(result.peek(), layout.time(x));
    if (event.buttons !== 0) holdPhase(at);
    else if (event.pointerType === "mouse") pointAt(at);
  };
  return { onPointerDown: look, onPointerMove: look, onPointerLeave: stopPointing };
}
