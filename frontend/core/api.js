/** Calls to the server. Every refusal becomes a `Problem` with the server's own words. */
import { API } from "./texts.js";

const BASE = new URL("../api/v1/", import.meta.url);

/** A refused or failed call. */
export class Problem extends Error {
  /**
   * @param {number} status of HTTP; 0 when the server did not answer
   * @param {string} title
   * @param {string} [detail]
   * @param {{path: string, message: string, allowed?: string}[]} [fields] of the request that were refused
   */
  constructor(status, title, detail, fields = []) {
    super(detail || title);
    this.status = status;
    this.title = title;
    this.fields = fields;
  }
}

export const link = (path) => new URL(path, BASE).href;

/**
 * @param {string} path under /api/v1, or a link of an answer
 * @param {{method?: string, body?: object, accept?: string, signal?: AbortSignal}} [options]
 */
export async function call(path, { method = "GET", body, accept = "application/json", signal } = {}) {
  /** @type {Record<string, string>} */
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

/**
 * One array of a finished job, from `start` to `stop` along its first axis.
 *
 * @param {string} id
 * @param {string} name
 * @param {{start?: number, stop?: number}} [part]
 */
export async function getArray(id, name, { start, stop } = {}) {
  const query = new URLSearchParams();
  if (start !== undefined) query.set("start", String(start));
  if (stop !== undefined) query.set("stop", String(stop));
  const response = await call(`jobs/${id}/arrays/${name}?${query}`, { accept: "application/octet-stream" });
  const shape = response.headers.get("X-Shape").split(",").map(Number);
  return { data: new Float32Array(await response.arrayBuffer()), shape, unit: response.headers.get("X-Unit") };
}

/** Whether a job still waits or runs. */
export const isActive = (job) => job !== null && ["accepted", "running"].includes(job.status);

async function problemOf(response) {
  /** @type {{title?: string, detail?: string, errors?: {path: string, message: string}[]}} */
  let body = {};
  try {
    body = await response.json();
  } catch {
    // A proxy may answer without JSON; then the status line must be enough.
  }
  return new Problem(response.status, body.title ?? response.statusText, body.detail, body.errors ?? []);
}

/**
 * The one-reply form of a result: uint32 header length, JSON header, then little-endian arrays.
 *
 * @param {ArrayBuffer} buffer
 * @returns {{header: any, arrays: Record<string, {data: Float32Array, shape: number[], unit: string}>}}
 */
export function decodeResult(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const first = 4 + length; // a multiple of 4: the header is padded
  /** @type {Record<string, {data: Float32Array, shape: number[], unit: string}>} */
  const arrays = {};
  for (const [name, { offset, shape, unit }] of Object.entries(header.arrays)) {
    const count = shape.reduce((product, n) => product * n, 1);
    arrays[name] = { data: new Float32Array(buffer, first + offset, count), shape, unit };
  }
  return { header, arrays };
}
