/** Dialogs: which one is open, and the frame that all share. */
import { html, readonly, signal, useLayoutEffect, useRef } from "./ui.js";
import { Icon } from "./widgets.js";
import { DIALOG } from "./texts.js";

const _open = signal(null); // null or {name, ...}: the open dialog

export const open = readonly(_open);

export function openDialog(name, about = {}) {
  _open.value = { name, ...about };
}

export function closeDialog() {
  _open.value = null;
}

export function Dialog({ title, wide = false, children }) {
  const dialog = useRef(null);
  useLayoutEffect(() => {
    const before = /** @type {HTMLElement | null} */ (document.activeElement);
    dialog.current.showModal();
    return () => before?.focus?.();
  }, []);
  return html`
    <dialog
      ref=${dialog}
      class=${wide ? "wide" : ""}
      aria-labelledby="dialog-title"
      onClose=${closeDialog}
      onClick=${(event) => event.target === dialog.current && closeDialog()}
    >
      <div class="dialog-body">
        <header class="dialog-head">
          <h2 id="dialog-title">${title}</h2>
          <button type="button" class="icon" aria-label=${DIALOG.close} onClick=${closeDialog}>
            <${Icon} name="close" />
          </button>
        </header>
        ${children}
      </div>
    </dialog>
  `;
}
