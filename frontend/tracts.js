/** Asks for the tract of a vowel when a picture first needs it. */
import { effect } from "./ui.js";
import { Problem, getJson } from "./api.js";
import { takeTract, tract, tractPath } from "./state/tract.js";

/** Starts following the vowel; returns the end of it. A refused vowel has no tract; its field says why. */
export function followTract() {
  const asked = new Set();
  return effect(() => {
    const path = tractPath.value;
    if (path === null || tract.value || asked.has(path)) return;
    asked.add(path);
    getJson(path).then(
      (answer) => takeTract(path, answer),
      (error) => {
        asked.delete(path);
        if (!(error instanceof Problem)) throw error;
      },
    );
  });
}
