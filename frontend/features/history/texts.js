/** Texts of the history. */

export const HISTORY = {
  title: "This visit",
  undo: "Undo",
  redo: "Redo",
  empty: "Every voice you stop at is listed here until the page is closed.",
  first: "Start",
  several: (n) => `${n} settings`,
};
