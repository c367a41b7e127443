/** Tabs in the pattern screen readers know: arrows move, one is in the tab order. */
import { html } from "../ui.js";

export function TabList({ name, texts, chosen, choose }) {
  const keys = Object.keys(texts);
  const onKeyDown = (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const next = keys[(keys.indexOf(chosen) + step + keys.length) % keys.length];
    choose(next);
    document.getElementById(`${name}-${next}`).focus();
  };
  return html`
    <div class=${`tabs ${name}-tabs`} role="tablist" onKeyDown=${onKeyDown}>
      ${keys.map((key) => html`
        <button
          key=${key} id=${`${name}-${key}`} type="button" role="tab" aria-selected=${key === chosen} aria-controls=${`${name}-content`}
          tabindex=${key === chosen ? 0 : -1} onClick=${() => choose(key)}
        >${texts[key]}</button>
      `)}
    </div>
  `;
}
