/** Asks the server which values are in force under the present model, whenever the model changes. */
import { effect, untracked } from "../../core/ui.js";
import { postJson, Problem } from "../../core/api.js";
import { LatestOnly } from "../../core/latest-only.js";
import { modelOf, nest } from "../../core/parameters.js";
import { awaitsDefaults, model, patch, schema, takeDefaults, takeNoDefaults } from "../../state/request.js";
import { connection, setConnection } from "../../state/session.js";
import { isBusy, RETRY_MS } from "./follow-request.js";

const resolved = async (ofModel) => (await postJson("resolve", nest(ofModel))).values;

/** {model, values}: the defaults under the model of `first`, or under the server's own where it refuses that model. */
export async function firstDefaults(first) {
  try {
    return { model: modelOf(first), values: await resolved(modelOf(first)) };
  } catch (error) {
    if (!(error instanceof Problem) || !error.fields.length) throw error;
    return { model: {}, values: await resolved({}) };
  }
}

/** Starts asking; returns a function that stops it. */
export function followDefaults() {
  let retry = 0;
  const failed = (error, ofModel) => {
    if (!(error instanceof Problem)) throw error;
    if (error.status === 401) return setConnection("login");
    if (!isBusy(error)) return takeNoDefaults(ofModel);
    setConnection("offline");
    clearTimeout(retry);
    retry = setTimeout(ask, RETRY_MS);
  };
  const take = (values, ofModel) => {
    setConnection("ready");
    takeDefaults(ofModel, values);
  };
  const calls = new LatestOnly(resolved, take, failed);
  const ask = () => awaitsDefaults.peek() && calls.push(modelOf(patch.peek()));
  const stop = effect(() => {
    if (!schema.value || connection.value === "login" || connection.value === "starting") return;
    void model.value;
    if (awaitsDefaults.value) untracked(ask);
  });
  return () => {
    stop();
    clearTimeout(retry);
  };
}
