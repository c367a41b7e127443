/** Copies text to the clipboard, with or without a secure context. */

/** Whether it worked. Call it from a click or a key. `markup`: the same as HTML, for documents that accept it. */
export async function copyText(text, markup) {
  try {
    if (markup === undefined) await navigator.clipboard.writeText(text);
    else
      await navigator.clipboard.write([
        new ClipboardItem({ "text/plain": plain(text), "text/html": new Blob([markup], { type: "text/html" }) }),
      ]);
    return true;
  } catch {
    return copySelected(text, markup);
  }
}

const plain = (text) => new Blob([text], { type: "text/plain" });

/** The old way, the only one for a page without TLS: select the text in a hidden field and copy the selection. */
function copySelected(text, markup) {
  const field = document.createElement("textarea");
  const before = /** @type {HTMLElement | null} */ (document.activeElement);
  field.value = text;
  field.className = "visually-hidden";
  field.setAttribute("aria-hidden", "true");
  // Text outside an open dialog cannot be selected.
  (document.querySelector("dialog[open]") ?? document.body).append(field);
  field.select();
  const give = (event) => {
    if (markup === undefined) return;
    event.clipboardData.setData("text/plain", text);
    event.clipboardData.setData("text/html", markup);
    event.preventDefault();
  };
  field.addEventListener("copy", give);
  try {
    return document.execCommand("copy");
  } finally {
    field.remove();
    before?.focus({ preventScroll: true });
  }
}
