/** Views that are fetched when they are first shown, so that the first view of the page waits for nothing it lacks. */
import { html, signal, useEffect } from "../ui.js";
import { APP } from "../texts.js";

/** `load()` → promise of a module that exports the view `name`. */
export function lazy(load, name) {
  const view = signal(null);
  const lost = signal(false);
  return function Later(props) {
    useEffect(() => {
      if (!view.peek()) load().then((module) => (view.value = module[name]), () => (lost.value = true));
    }, []);
    if (lost.value) return html`<p class="refusal" role="alert">${APP.offline}</p>`;
    return view.value && html`<${view.value} ...${props} />`;
  };
}
