/** Small views that every feature uses: icons, tabs, and views that are loaded when they are first shown. */
import { html, signal, useEffect } from "./ui.js";
import { APP } from "./texts.js";

const PATHS = {
  mark: () => html`
    <path d="M4 12C7 6 9.5 5 12 5s5 1 8 7c-3 6-5.5 7-8 7s-5-1-8-7Z" />
    <path d="M6.5 12c2-1.7 3.7-2.3 5.5-2.3s3.5.6 5.5 2.3c-2 1.7-3.7 2.3-5.5 2.3S8.5 13.7 6.5 12Z" fill="currentColor" />
  `,
  link: () => html`
    <path d="M10 14a4 4 0 0 0 5.7 0l3-3a4 4 0 1 0-5.7-5.7l-1 1M14 10a4 4 0 0 0-5.7 0l-3 3a4 4 0 1 0 5.7 5.7l1-1" />
  `,
  sun: () => html`
    <circle cx="12" cy="12" r="4" />
    <path d="M12 3v2M12 19v2M3 12h2M19 12h2M5.6 5.6 7 7M17 17l1.4 1.4M5.6 18.4 7 17M17 7l1.4-1.4" />
  `,
  moon: () => html`
    <path d="M20 14.5A8.5 8.5 0 0 1 9.5 4a8.5 8.5 0 1 0 10.5 10.5Z" />
  `,
  help: () => html`
    <circle cx="12" cy="12" r="9" />
    <path d="M9.5 9.5a2.5 2.5 0 1 1 3.4 2.3c-.6.3-.9.8-.9 1.5v.4M12 17v.01" />
  `,
  play: () => html`
    <path d="M8 5v14l11-7Z" fill="currentColor" />
  `,
  pause: () => html`
    <path d="M8 5v14M16 5v14" stroke-width="3" />
  `,
  stop: () => html`
    <rect x="6.5" y="6.5" width="11" height="11" rx="1.5" fill="currentColor" />
  `,
  record: () => html`
    <circle cx="12" cy="12" r="6" fill="currentColor" stroke="none" />
  `,
  save: () => html`
    <path d="M12 4v11m-4.5-4L12 15.5 16.5 11M5 19.5h14" />
  `,
  repeat: () => html`
    <path d="M5 12V9.5A2.5 2.5 0 0 1 7.5 7H18m-3-3 3 3-3 3M19 12v2.5a2.5 2.5 0 0 1-2.5 2.5H6m3 3-3-3 3-3" />
  `,
  zoom: () => html`
    <circle cx="11" cy="11" r="6" />
    <path d="m15.5 15.5 4.5 4.5M8.5 11h5M11 8.5v5" />
  `,
  undo: () => html`
    <path d="M8.5 5 4.5 9l4 4M5 9h9a5 5 0 0 1 0 10h-3" />
  `,
  redo: () => html`
    <path d="m15.5 5 4 4-4 4M19 9h-9a5 5 0 0 0 0 10h3" />
  `,
  keep: () => html`
    <path d="M6 4h12v16l-6-4-6 4Z" />
  `,
  close: () => html`
    <path d="M6 6l12 12M18 6 6 18" />
  `,
};

export function Icon({ name }) {
  return html`
    <svg
      class="icon-drawing"
      viewBox="0 0 24 24"
      width="20"
      height="20"
      fill="none"
      stroke="currentColor"
      stroke-width="1.8"
      stroke-linecap="round"
      stroke-linejoin="round"
      aria-hidden="true"
    >
      ${PATHS[name]()}
    </svg>
  `;
}

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
      ${keys.map(
        (key) => html`
          <button
            key=${key}
            id=${`${name}-${key}`}
            type="button"
            role="tab"
            aria-selected=${key === chosen}
            aria-controls=${`${name}-content`}
            tabindex=${key === chosen ? 0 : -1}
            onClick=${() => choose(key)}
          >
            ${texts[key]}
          </button>
        `,
      )}
    </div>
  `;
}

/** A view that is loaded when first shown. `load()` → promise of a module that exports the view `name`. */
export function lazy(load, name) {
  const view = signal(null);
  const lost = signal(false);
  return function Later(props) {
    useEffect(() => {
      if (!view.peek())
        load().then(
          (module) => (view.value = module[name]),
          () => (lost.value = true),
        );
    }, []);
    if (lost.value)
      return html`
        <p class="refusal" role="alert">${APP.offline}</p>
      `;
    return (
      view.value &&
      html`
        <${view.value} ...${props} />
      `
    );
  };
}
