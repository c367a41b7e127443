/** A line at the phase shown, over a picture whose width is some cycles; dragging or pointing moves the phase. */
import { effect, html, useEffect, useRef } from "../ui.js";
import { Disposal } from "../dispose.js";
import { holdPhase, phase, pointAt, stopPointing } from "../state/motion.js";

/** `fieldOf(box)` → {left, right, top, bottom} in px; `cycles` across it. */
export function PhaseCursor({ name, fieldOf, cycles }) {
  const place = useRef(null);
  useEffect(() => follow(place.current, fieldOf, cycles), []);
  const look = (event) => {
    const element = place.current;
    const field = fieldOf({ width: element.clientWidth, height: element.clientHeight });
    const x = event.clientX - element.getBoundingClientRect().left;
    if (x < field.left || x > field.right) return stopPointing();
    const at = ((x - field.left) / (field.right - field.left)) * cycles;
    if (event.buttons !== 0) holdPhase(at);
    else if (event.pointerType === "mouse") pointAt(at);
  };
  return html`
    <div ref=${place} class="phase-cursor" data-picture=${name} onPointerDown=${look} onPointerMove=${look} onPointerLeave=${stopPointing}>
      ${Array.from({ length: cycles }, (_, k) => html`<i key=${k}></i>`)}
    </div>
  `;
}

function follow(element, fieldOf, cycles) {
  const disposal = new Disposal();
  let field = null;
  const measure = () => {
    field = fieldOf({ width: element.clientWidth, height: element.clientHeight });
    for (const line of element.children) Object.assign(line.style, { top: `${field.top}px`, height: `${field.bottom - field.top}px` });
    move();
  };
  const move = () => {
    const cycle = (field.right - field.left) / cycles;
    [...element.children].forEach((line, k) => (line.style.transform = `translateX(${field.left + (k + phase.peek()) * cycle}px)`));
  };
  const observer = new ResizeObserver(measure);
  observer.observe(element);
  disposal.add(() => observer.disconnect());
  measure();
  disposal.add(effect(() => (void phase.value, move())));
  return () => disposal.dispose();
}
