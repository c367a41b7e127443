/** A played voice as the page sees it: messages out, states in. The sound goes from worker to worklet, see wire.js. */
import { link } from "../api.js";

/**
 * @param line the worklet's end of a MessageChannel; it goes to the worker.
 * @param handlers `said(document)` for every text frame, `report(buffer)`, `sounded({stamp, at})` when the first block
 *   that follows a stamped message begins, `ended(reason)` once.
 */
export class Connection {
  #worker = new Worker(new URL("wire.js", import.meta.url), { type: "module" });

  constructor(request, line, handlers) {
    this.#worker.onmessage = ({ data }) => {
      for (const [kind, what] of Object.entries(data)) handlers[kind](what);
    };
    this.#worker.onerror = () => handlers.ended("");
    this.#worker.postMessage({ open: { url: link("live").replace(/^http/, "ws"), first: request, line } }, [line]);
  }

  send(message) {
    this.#worker.postMessage({ send: message });
  }

  close() {
    this.#worker.onmessage = null;
    this.#worker.postMessage({ close: true });
  }
}
