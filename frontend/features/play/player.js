/**
 * Plays the voice live: connects the server's voice to an audio worklet while the user moves controls. Sound starts
 * only after a click or a key.
 */
import { effect, untracked } from "../../core/ui.js";
import { link } from "../../core/api.js";
import { recordShown, waitFrom } from "../../core/latency.js";
import { nest } from "../../core/parameters.js";
import { setStatus, status, takeBuffer, takeGesture, takePlayProblem, takeState } from "../../state/played-voice.js";
import { awaitsDefaults, patch, schema, values, version } from "../../state/request.js";
import { PLAY } from "./texts.js";
import { gainOf, setPlaying, volume } from "../sound/sound.js";

const RATE = 48000; // the context resamples to the rate of the device
const FADE_IN_S = 0.15;
const FADE_OUT_S = 0.06;
const KNEE = 0.5; // of full scale: louder samples approach 1 and never exceed it, without look-ahead
const LOUDEST = 4; // the server's full scale has room for 170 dB; modal voice peaks at a tenth of it
const FIXED = /^(run|model)\./; // while a voice is played

let session = null;

export const canPlay = () => typeof AudioWorkletNode !== "undefined" && window.isSecureContext;

/** Call it from a click or a key. */
export async function startPlaying() {
  if (session) return;
  setPlaying(false); // the loop and the live voice never sound together
  setStatus("starting");
  const mine = (session = new Session());
  try {
    await mine.start();
  } catch (error) {
    if (session === mine) stopPlaying(PLAY.failed(error.message));
  }
}

export function stopPlaying(why = "") {
  session?.stop();
  session = null;
  setStatus("off");
  takePlayProblem(why);
}

/** Replace `old` by a voice of the present request, unless it has ended meanwhile. */
function restart(old) {
  if (session !== old) return;
  stopPlaying();
  startPlaying();
}

export function setRecording(on) {
  session?.send({ record: on });
}

/** The audio graph of the played voice, for the spectrum and for tests; null when it is off. */
export const soundGraph = () => session?.graph ?? null;

class Session {
  #ends = [];
  #sent = null;
  #connection = null;

  async start() {
    // "interactive" may buffer 30 ms; 0 requests the least that the device can do.
    const context = new AudioContext({ sampleRate: RATE, latencyHint: 0 });
    this.#ends.push(() => context.close());
    await context.audioWorklet.addModule(new URL("stream-worklet.js", import.meta.url));
    const node = new AudioWorkletNode(context, "vocalis-stream", { numberOfInputs: 0, outputChannelCount: [1] });
    const gain = new GainNode(context, { gain: 0 });
    const limiter = new WaveShaperNode(context, { curve: bend() });
    const analyser = new AnalyserNode(context, { fftSize: 4096, smoothingTimeConstant: 0.5 });
    node.connect(gain).connect(limiter).connect(analyser).connect(context.destination);
    this.graph = { context, node, gain, analyser };
    await context.resume();
    const channel = new MessageChannel();
    node.port.postMessage({ line: channel.port1 }, [channel.port1]);
    this.#sent = patch.peek();
    waitFrom("slider to sound", version.peek());
    this.#connection = new Connection(nest(this.#sent), channel.port2, {
      received: (document) => this.#receive(document),
      report: (buffer) => session === this && takeBuffer(buffer),
      sounded: ({ stamp, at }) => recordShown("slider to sound", stamp, outputTime(context, at)),
      ended: (reason) => session === this && stopPlaying(reason ? PLAY.ended(reason) : PLAY.gone),
    });
    this.#ends.push(() => this.#connection.close());
    this.#ends.push(
      effect(() => {
        gain.gain.setTargetAtTime(LOUDEST * gainOf(volume.value), context.currentTime, FADE_IN_S / 3);
      }),
    );
    this.#ends.push(effect(() => this.#follow(patch.value)));
  }

  send(message) {
    this.#connection?.send(message);
  }

  stop() {
    const { context, gain } = this.graph ?? {};
    if (gain) gain.gain.setTargetAtTime(0, context.currentTime, FADE_OUT_S / 6);
    const ends = this.#ends.splice(0).reverse();
    setTimeout(() => ends.forEach((end) => end()), gain ? FADE_OUT_S * 1000 : 0);
  }

  /** Sends only what changed; for an entry that is gone, the default in force. */
  #follow(next) {
    if (awaitsDefaults.value || next === this.#sent) return;
    const [before, now] = [this.#sent, values.peek()];
    const paths = Object.keys({ ...before, ...next }).filter((path) => next[path] !== before[path]);
    this.#sent = next;
    if (paths.some((path) => isAnotherVoice(path, before, next))) return queueMicrotask(() => restart(this));
    if (paths.length)
      this.send({ ...nest(Object.fromEntries(paths.map((path) => [path, now[path]]))), stamp: version.peek() });
  }

  #receive(document) {
    if (session !== this) return; // it was stopped and is fading out
    untracked(() => {
      if (document.type === "state") takeState(document);
      else if (document.type === "gesture") takeGesture(document.gesture);
      else if (document.type === "problem") {
        if (document.over) stopPlaying(document.problem.detail);
        else takePlayProblem(document.problem.detail);
      }
    });
  }
}

/** The time at which a moment of the worklet leaves the loudspeaker, on the page's clock. */
function outputTime(context, at) {
  const { contextTime, performanceTime } = context.getOutputTimestamp();
  return performanceTime + (at - contextTime) * 1000;
}

/** Linear up to KNEE, then a smooth bend; a WaveShaperNode clamps values beyond ±1. */
function bend() {
  const curve = (x) => (x < KNEE ? x : KNEE + (1 - KNEE) * Math.tanh((x - KNEE) / (1 - KNEE)));
  return Float32Array.from({ length: 2049 }, (_, k) => Math.sign(k - 1024) * curve(Math.abs(k - 1024) / 1024));
}

/**
 * Whether a change needs another voice: other equations, or an optional part, a value of a side or a lesion that may
 * have come or gone.
 */
function isAnotherVoice(path, before, after) {
  const optional = schema.peek().parameters.get(path)?.optional_part !== null;
  return FIXED.test(path) || (optional && !(path in before && path in after));
}

/** Whether the voice is on or starting. */
export const isOn = () => status.value !== "off";

/**
 * A played voice as the page sees it: messages out, states in. The sound goes from worker to worklet, see
 * connection-worker.js.
 */
export class Connection {
  #worker = new Worker(new URL("connection-worker.js", import.meta.url), { type: "module" });

  constructor(request, worklet, handlers) {
    this.#worker.onmessage = ({ data }) => {
      for (const [kind, what] of Object.entries(data)) handlers[kind](what);
    };
    this.#worker.onerror = () => handlers.ended("");
    this.#worker.postMessage({ open: { url: link("live").replace(/^http/, "ws"), first: request, worklet } }, [
      worklet,
    ]);
  }

  send(message) {
    this.#worker.postMessage({ send: message });
  }

  close() {
    this.#worker.onmessage = null;
    this.#worker.postMessage({ close: true });
  }
}
