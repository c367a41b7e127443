/** A canvas that follows state. */
import { effect, html, signal, useEffect, useRef } from "./ui.js";
import { prepare } from "./canvas.js";
import { Disposal } from "./dispose.js";
import { offer } from "./export.js";
import { forget, inFrame } from "./frame.js";

/**
 * `model()` reads signals and may return null (nothing to show); `paint(context, box, model)` draws it once in the next
 * frame, however often the state has changed since. `ground(model)`: the colour behind it, if there is one. A picture
 * with a `title` can be exported while it is on the page.
 */
export function Picture({ model, paint, label, name, ground, title }) {
  const canvas = useRef(null);
  useEffect(() => follow(canvas.current, model, paint, ground), []);
  useEffect(() => {
    if (!title) return;
    const size = () => ({ width: canvas.current.clientWidth, height: canvas.current.clientHeight });
    return offer({ name, title, model, paint, size });
  }, [title]);
  const words = label ? { role: "img", "aria-label": label } : { "aria-hidden": "true" };
  return html`
    <canvas ref=${canvas} class="picture" data-picture=${name} ...${words}></canvas>
  `;
}

function follow(canvas, model, paint, ground) {
  const disposal = new Disposal();
  const size = signal({ width: 0, height: 0 });
  const observer = new ResizeObserver(([entry]) => {
    size.value = { width: entry.contentRect.width, height: entry.contentRect.height };
  });
  observer.observe(canvas);
  disposal.add(() => observer.disconnect());
  disposal.add(() => forget(canvas));
  disposal.add(
    effect(() => {
      const box = size.value;
      const shown = model();
      inFrame(canvas, () => {
        const context = prepare(canvas, box.width, box.height, shown && ground?.(shown));
        if (context && shown) paint(context, box, shown);
      });
    }),
  );
  return () => disposal.dispose();
}
