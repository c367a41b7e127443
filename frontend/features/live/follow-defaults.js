/** Requests the values in force from the server whenever their basis changes: the model, or which parts are given. */
import { effect, untracked } from "../../core/ui.js";
import { postJson, Problem } from "../../core/api.js";
import { LatestOnly } from "../../core/latest-only.js";
import { basisOf, nest } from "../../core/parameters.js";
import { awaitsDefaults, basis, patch, schema, takeDefaults, takeNoDefaults } from "../../state/request.js";
import { entered, setConnection } from "../../state/session.js";
import { isBusy, RETRY_MS } from "./follow-request.js";

const resolved = async (ofBasis) => (await postJson("resolve", nest(ofBasis))).values;

/** {basis, values}: the defaults under the basis of `first`, or under an empty one if the server refuses that. */
export async function firstDefaults(ofSchema, first) {
  const asked = basisOf(ofSchema, first);
  try {
    return { basis: asked, values: await resolved(asked) };
  } catch (error) {
    if (!(error instanceof Problem) || !error.fields.length) throw error;
    return { basis: {}, values: await resolved({}) };
  }
}

/** Starts asking; returns a function that stops it. */
export function followDefaults() {
  let retry = 0;
  const failed = (error, ofBasis) => {
    if (!(error instanceof Problem)) throw error;
    if (error.status === 401) return setConnection("login");
    if (!isBusy(error)) return takeNoDefaults(ofBasis);
    setConnection("offline");
    clearTimeout(retry);
    retry = setTimeout(ask, RETRY_MS);
  };
  const take = (values, ofBasis) => {
    setConnection("ready");
    takeDefaults(ofBasis, values);
  };
  const calls = new LatestOnly(resolved, take, failed);
  const ask = () => awaitsDefaults.peek() && calls.push(basisOf(schema.peek(), patch.peek()));
  const stop = effect(() => {
    if (!schema.value || !entered.value) return;
    void basis.value;
    if (awaitsDefaults.value) untracked(ask);
  });
  return () => {
    stop();
    clearTimeout(retry);
  };
}
