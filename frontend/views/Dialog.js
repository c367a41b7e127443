/** A dialog on top: the browser's own, with its focus and Escape; closed by the button or a click beside it. */
import { html, useLayoutEffect, useRef } from "../ui.js";
import { Icon } from "../controls/Icon.js";
import { closeDialog } from "../state/look.js";
import { HELP } from "../texts.js";

export function Dialog({ title, wide = false, children }) {
  const dialog = useRef(null);
  useLayoutEffect(() => {
    const before = document.activeElement;
    dialog.current.showModal();
    return () => before?.focus?.();
  }, []);
  return html`
    <dialog ref=${dialog} class=${wide ? "wide" : ""} aria-labelledby="dialog-title" onClose=${closeDialog} onClick=${(event) => event.target === dialog.current && closeDialog()}>
      <div class="dialog-body">
        <header class="dialog-head">
          <h2 id="dialog-title">${title}</h2>
          <button type="button" class="icon" aria-label=${HELP.close} onClick=${closeDialog}><${Icon} name="close" /></button>
        </header>
        ${children}
      </div>
    </dialog>
  `;
}
