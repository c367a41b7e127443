/** State of the Paper section: its figures, the voice on display, and the figure that is being computed again. */
import { batch, computed, readonly, signal } from "../../core/ui.js";

const _voice = signal("modal"); // modal | pca_half | pca_full
const _document = signal(null);
const _problem = signal("");
/** @type {import("@preact/signals").Signal<Record<string, {figure: any, made: object}>>} */
const _fresh = signal({}); // {key: {figure, made}}
const _run = signal(null); // {key, done, total}

/** Which of the three voices is on display. */
export const voiceShown = readonly(_voice);
/** The shipped document: {provenance, figures, claims}; null until it is loaded. */
export const paper = readonly(_document);
export const paperProblem = readonly(_problem);
/** Figures computed by this page: {key: {figure, made}}. */
export const fresh = readonly(_fresh);
/** The present run: {key, done, total}, or null. */
export const paperRun = readonly(_run);
/** Figures by key: those computed here replace the shipped ones. */
export const figures = computed(() => {
  if (!_document.value) return null;
  const own = Object.fromEntries(Object.entries(_fresh.value).map(([key, { figure }]) => [key, figure]));
  return { ..._document.value.figures, ...own };
});

export function setVoiceShown(key) {
  _voice.value = key;
}

export function takePaper(document) {
  batch(() => {
    _document.value = document;
    _problem.value = "";
  });
}

export function takePaperProblem(text) {
  _problem.value = text;
}

export function takeRun(run) {
  _run.value = run;
}

export function takeFresh(figure, made) {
  batch(() => {
    _fresh.value = { ..._fresh.value, [figure.key]: { figure, made } };
    _run.value = null;
  });
}

/** @param {string} key */
export function backToShipped(key) {
  const { [key]: gone, ...rest } = _fresh.value;
  _fresh.value = rest;
}
