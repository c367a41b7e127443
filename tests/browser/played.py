"""A played voice, and a recording of its output.

A worklet in parallel with the loudspeaker records every sample (TAPE); the files of the page are unchanged.
"""

import base64
import threading
import time

import numpy as np

RATE = 48000
QUANTUM = 128
#: Connects a recorder wherever the loudspeaker is connected.
TAPE = """
const WORKLET = `registerProcessor("tape", class extends AudioWorkletProcessor {
  process([[channel]]) {
    if (channel) this.port.postMessage({ frame: currentFrame, samples: channel.slice() });
    return true;
  }
})`;
window.tapes = [];
const connect = AudioNode.prototype.connect;
AudioNode.prototype.connect = function (target, ...rest) {
  if (target === this.context.destination) {
    const tape = { frames: [], samples: [] };
    window.tapes.push(tape);
    const address = URL.createObjectURL(new Blob([WORKLET], { type: "text/javascript" }));
    this.context.audioWorklet.addModule(address).then(() => {
      const node = new AudioWorkletNode(this.context, "tape");
      node.port.onmessage = ({ data }) => { tape.frames.push(data.frame); tape.samples.push(data.samples); };
      connect.call(this, node);
      connect.call(node, this.context.destination); // silent; what leads nowhere is not asked for samples
    });
  }
  return connect.call(this, target, ...rest);
};
"""
READ = """() => {
  const { frames, samples } = window.tapes.at(-1);
  const all = new Float32Array(samples.length * 128);
  samples.forEach((block, k) => all.set(block, 128 * k));
  const bytes = new Uint8Array(all.buffer);
  let text = "";
  for (let k = 0; k < bytes.length; k += 32768) text += String.fromCharCode(...bytes.subarray(k, k + 32768));
  return { frames, text: btoa(text) };
}"""
BUFFER = "async () => (await import('/state/played-voice.js')).buffer.value"


class Watch:
    """Measures how long threads have to wait on this machine, which makes gaps unavoidable."""

    def __enter__(self):
        self.longest_s, self._on = 0.0, True
        threading.Thread(target=self._look, daemon=True).start()
        return self

    def _look(self) -> None:
        while self._on:
            began = time.monotonic()
            time.sleep(0.005)
            self.longest_s = max(self.longest_s, time.monotonic() - began - 0.005)

    def __exit__(self, *_):
        self._on = False


class Played:
    """A visit on which the voice is played, and its recording."""

    def __init__(self, here):
        self.here, self.page = here, here.page
        self.missing = 0  # blocks missing from the last recording: an overloaded browser drops some

    def start(self) -> "Played":
        self.page.get_by_role("tab", name="Play", exact=True).click()
        self.page.get_by_role("button", name="Play live").click()
        return self.sounding()

    def sounding(self) -> "Played":
        self.page.locator(".play-now", has_text="Hz").wait_for(timeout=60_000)  # the first voice compiles kernels
        self.page.wait_for_timeout(1000)
        return self

    def at(self) -> int:
        """The number of samples recorded so far."""
        return QUANTUM * self.page.evaluate("window.tapes.at(-1).frames.length")

    def hold(self, seconds: float) -> slice:
        """Play for a while; returns the recording of that time, after sound that is still buffered."""
        self.page.wait_for_timeout(300)
        first = self.at()
        self.page.wait_for_timeout(1000 * seconds)
        return slice(first, self.at())

    def drag(self, path: str, share: float) -> None:
        """Drag a slider's knob from its place to a share of the track, like a user."""
        box = self.here.slider(path).bounding_box()
        y = box["y"] + box["height"] / 2
        now = float(self.here.slider(path).input_value())
        self.page.mouse.move(box["x"] + now * box["width"], y)
        self.page.mouse.down()
        for k in range(1, 11):
            self.page.mouse.move(box["x"] + (now + (share - now) * k / 10) * box["width"], y)
            self.page.wait_for_timeout(20)
        self.page.mouse.up()

    def drag_back_and_forth(self, path: str, seconds: float, pace_ms: int = 50) -> None:
        """Drag back and forth without a pause."""
        box = self.here.slider(path).bounding_box()
        y = box["y"] + box["height"] / 2
        self.page.mouse.move(box["x"] + 0.5 * box["width"], y)
        self.page.mouse.down()
        until, k = time.monotonic() + seconds, 0
        while time.monotonic() < until:
            k += 1
            self.page.mouse.move(box["x"] + (0.5 + 0.35 * np.sin(k / 6)) * box["width"], y)
            self.page.wait_for_timeout(pace_ms)
        self.page.mouse.up()

    def pad(self, ct: float, ta: float) -> None:
        """Press the pad near these activations."""
        box = self.page.locator(".play-pad canvas").bounding_box()
        self.page.mouse.click(box["x"] + (0.12 + 0.85 * ct) * box["width"], box["y"] + (0.9 - 0.8 * ta) * box["height"])

    def gaps(self) -> int:
        return self.page.evaluate(BUFFER)["gaps"]

    def tape(self) -> np.ndarray:
        answer = self.page.evaluate(READ)
        self.missing = int(np.sum(np.diff(answer["frames"]) // QUANTUM - 1))
        return np.frombuffer(base64.b64decode(answer["text"]), "<f4").astype(float)

    def value(self, muscle: str) -> float:
        return float(self.here.slider(f"activation.{muscle}").input_value())
