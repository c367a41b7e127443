/** Calls to the server. Every refusal becomes a `Problem` that says what the server said. */
import { decodeResult } from "./octets.js";
import { API } from "./texts.js";

const BASE = new URL("api/v1/", import.meta.url);

/** A refused or failed call. `fields`: [{path, message, allowed}] of the request, empty when it is not about a field. */
export class Problem extends Error {
  constructor(status, title, detail, fields = []) {
    super(detail || title);
    this.status = status;
    this.title = title;
    this.fields = fields;
  }
}

export const link = (path) => new URL(path, BASE).href;

/** `path` under /api/v1, or a link of an answer. */
export async function call(path, { method = "GET", body, accept = "application/json", signal } = {}) {
  const headers = { Accept: accept };
  if (body !== undefined) headers["Content-Type"] = "application/json";
  let response;
  try {
    response = await fetch(link(path), {
      method,
      headers,
      signal,
      body: body === undefined ? undefined : JSON.stringify(body),
      credentials: "same-origin",
    });
  } catch (error) {
    if (error.name === "AbortError") throw error;
    throw new Problem(0, API.noAnswer, API.silent);
  }
  if (!response.ok) throw await problemOf(response);
  return response;
}

export const getJson = async (path, options) => (await call(path, options)).json();

export const postJson = async (path, body) => (await call(path, { method: "POST", body })).json();

/** Run a request and decode its one-reply form with the arrays named. */
export async function simulate(body, arrays, signal) {
  const response = await call(`simulate?arrays=${arrays.join(",")}`, {
    method: "POST",
    body,
    accept: "application/octet-stream",
    signal,
  });
  return decodeResult(await response.arrayBuffer());
}

/** One array of a finished job, from `start` on along its first axis. */
export async function getArray(id, name, { start, stop } = {}) {
  const query = new URLSearchParams();
  if (start !== undefined) query.set("start", start);
  if (stop !== undefined) query.set("stop", stop);
  const response = await call(`jobs/${id}/arrays/${name}?${query}`, { accept: "application/octet-stream" });
  const shape = response.headers.get("X-Shape").split(",").map(Number);
  return { data: new Float32Array(await response.arrayBuffer()), shape, unit: response.headers.get("X-Unit") };
}

async function problemOf(response) {
  let body = {};
  try {
    body = await response.json();
  } catch {
    // Not every intermediary answers in JSON; the status line then has to do.
  }
  return new Problem(response.status, body.title ?? response.statusText, body.detail, body.errors ?? []);
}
