/** Notes of the person at the page. They stay in this browser and go nowhere. */
import { signal } from "../ui.js";
import { readonly } from "./readonly.js";

const KEY = "vocalis.notes";
const _notes = signal(localStorage.getItem(KEY) ?? "");

export const notes = readonly(_notes);

export function setNotes(text) {
  _notes.value = text;
  if (text) localStorage.setItem(KEY, text);
  else localStorage.removeItem(KEY);
}
