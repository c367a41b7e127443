/** What the model answered: posture at once, the voice a moment later, or why not. */
import { batch, signal } from "../ui.js";
import { readonly } from "./readonly.js";

const _posture = signal(null);
const _before = signal(null);
const _result = signal(null);
const _problems = signal({});
const _failure = signal("");

/** {posture, coefficients, static_shape, version} of the newest answered posture. */
export const posture = readonly(_posture);
/** The posture before the present hand movement: what changes are counted from. */
export const before = readonly(_before);
/** The newest voice, see result.js. */
export const result = readonly(_result);
/** Refused fields: {path: {message, allowed}}. */
export const problems = readonly(_problems);
/** Why there is no answer, when that is not about one field. */
export const failure = readonly(_failure);

let gestureShown = 0;

export function takePosture(answer, gesture) {
  batch(() => {
    if (gesture !== gestureShown) {
      _before.value = _posture.value;
      gestureShown = gesture;
    }
    _posture.value = answer;
    _problems.value = {};
    _failure.value = "";
  });
}

export function takeResult(answer) {
  batch(() => {
    _result.value = answer;
    _failure.value = "";
  });
}

export function takeProblem(problem) {
  batch(() => {
    _problems.value = Object.fromEntries(problem.fields.map(({ path, ...rest }) => [path, rest]));
    _failure.value = problem.fields.length ? "" : problem.message;
  });
}
