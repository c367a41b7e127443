/** The model's answers: the posture at once, the voice a moment later, or why there is none. */
import { batch, computed, readonly, signal } from "../core/ui.js";

/** @type {{fields: Record<string, {message: string, allowed?: string}>, text: string}} */
const NONE = { fields: {}, text: "" };

const _posture = signal(null);
const _postureBefore = signal(null);
const _result = signal(null);
const _answered = signal(0);
const _refusals = signal({ posture: NONE, voice: NONE });

/** {posture, coefficients, static_shape} of the newest answer. */
export const posture = readonly(_posture);
/** The posture before the present movement of a control, from which changes are counted. */
export const postureBefore = readonly(_postureBefore);
/** The newest voice, see result.js. */
export const result = readonly(_result);
/** Version of the request that was last answered with a voice or a refusal. */
export const answered = readonly(_answered);
/** Refused fields, whichever call refused them: {path: {message, allowed}}. */
export const problems = computed(() => ({ ..._refusals.value.voice.fields, ..._refusals.value.posture.fields }));
/** Why there is no answer, if the reason is not a field. */
export const failure = computed(() => _refusals.value.posture.text || _refusals.value.voice.text);

let movementShown = 0;

/** `movement`: the number of the movement that the answer belongs to, see request.js. */
export function takePosture(answer, movement) {
  batch(() => {
    if (movement !== movementShown) {
      _postureBefore.value = _posture.value;
      movementShown = movement;
    }
    _posture.value = answer;
    refuse("posture", NONE);
  });
}

/** `version`: of the answered request; omitted for a run that was not live. */
export function takeResult(answer, version = _answered.value) {
  batch(() => {
    _result.value = answer;
    _answered.value = version;
    refuse("voice", NONE);
  });
}

/** `call`: posture or voice. */
export function takeProblem(call, problem, version) {
  batch(() => {
    if (call === "voice") _answered.value = version;
    const fields = Object.fromEntries(problem.fields.map(({ path, ...rest }) => [path, rest]));
    refuse(call, { fields, text: problem.fields.length ? "" : problem.message });
  });
}

function refuse(call, refusal) {
  if (refusal !== _refusals.peek()[call]) _refusals.value = { ..._refusals.peek(), [call]: refusal };
}
