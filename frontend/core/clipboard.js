/** Copies text to the clipboard, with or without a secure context. */

/** Whether it worked; to be called inside a gesture. `markup`: the same as HTML, for documents that take it. */
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

/** The old way, the only one a page without TLS has: select it in a field nobody sees, and ask for a copy. */
function copySelected(text, markup) {
  const field = document.createElement("textarea");
  const before = /** @type {HTMLElement | null} */ (document.activeElement);
  field.value = text;
  field.className = "visually-hidden";
  field.setAttribute("aria-hidden", "true");
  // What lies outside an open dialog cannot be selected.
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
