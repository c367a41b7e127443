/** Focus a control from anywhere by its parameter path (keys 1–5, tests, links in hints). */
export function focusControl(path) {
  document.getElementById(controlId(path))?.focus();
}

export const controlId = (path) => `control-${path.replaceAll(".", "-")}`;
