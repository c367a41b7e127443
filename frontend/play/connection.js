/** The web socket of a played voice: messages out, sound and states in. Knows neither audio nor page. */
import { link } from "../api.js";

const HEADER = 4; // uint32 sequence number

/**
 * @param handlers `sound(samples, sequence)`, `said(document)` for every text frame, `ended(reason)` once.
 */
export class Connection {
  #socket;
  #open = false;
  #first;
  #over = false;

  constructor(request, handlers) {
    const url = link("live").replace(/^http/, "ws");
    this.#first = request;
    this.#socket = new WebSocket(url);
    this.#socket.binaryType = "arraybuffer";
    this.#socket.onopen = () => {
      this.#open = true;
      this.send(this.#first);
    };
    this.#socket.onmessage = ({ data }) => {
      if (typeof data === "string") return handlers.said(JSON.parse(data));
      handlers.sound(new Float32Array(data, HEADER), new DataView(data).getUint32(0, true));
    };
    this.#socket.onclose = ({ reason }) => {
      if (this.#over) return;
      this.#over = true;
      handlers.ended(reason);
    };
  }

  /** Send a message; before the socket is open it becomes part of the first one. */
  send(message) {
    if (this.#open) this.#socket.send(JSON.stringify(message));
    else this.#first = { ...this.#first, ...message };
  }

  close() {
    this.#over = true;
    this.#socket.close();
  }
}
