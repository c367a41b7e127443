"""The played voice as it is heard: every sample that leaves for the loudspeaker is read back while a hand plays.

A worklet beside the loudspeaker keeps the samples (TAPE); the page's own files stay as they are.
"""

import base64
import threading
import time

import numpy as np
import pytest

import vfcore
from tests.browser.conftest import PHONE
from tests.browser.test_page_sound import pitch_hz

pytestmark = pytest.mark.alone

RATE = 48000
QUANTUM = 128
STANDS_STILL_S = 0.05
#: Puts a tape beside the loudspeaker.
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
  const octets = new Uint8Array(all.buffer);
  let text = "";
  for (let k = 0; k < octets.length; k += 32768) text += String.fromCharCode(...octets.subarray(k, k + 32768));
  return { frames, text: btoa(text) };
}"""
BUFFER = "async () => (await import('/state/play.js')).buffer.value"


class Watch:
    """Notices when the machine does not let a thread run in time: no sound can be without gaps then."""

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
    """A visit on which the voice is played, and its tape."""

    def __init__(self, here):
        self.here, self.page = here, here.page

    def start(self) -> "Played":
        self.page.get_by_role("tab", name="Play", exact=True).click()
        self.page.get_by_role("button", name="Play live").click()
        return self.sounding()

    def sounding(self) -> "Played":
        self.page.locator(".play-now", has_text="Hz").wait_for(timeout=60_000)  # the first voice compiles
        self.page.wait_for_timeout(1000)
        return self

    def at(self) -> int:
        """How many samples the tape has now."""
        return QUANTUM * self.page.evaluate("window.tapes.at(-1).frames.length")

    def hold(self, seconds: float) -> slice:
        """Let it sound; the part of the tape that was taken meanwhile, after what is still on its way."""
        self.page.wait_for_timeout(300)
        first = self.at()
        self.page.wait_for_timeout(1000 * seconds)
        return slice(first, self.at())

    def drag(self, path: str, share: float) -> None:
        """Take a slider's knob where it is and move it to a share of the track, as a hand does."""
        box = self.here.slider(path).bounding_box()
        y = box["y"] + box["height"] / 2
        now = float(self.here.slider(path).input_value())
        self.page.mouse.move(box["x"] + now * box["width"], y)
        self.page.mouse.down()
        for k in range(1, 11):
            self.page.mouse.move(box["x"] + (now + (share - now) * k / 10) * box["width"], y)
            self.page.wait_for_timeout(20)
        self.page.mouse.up()

    def sway(self, path: str, seconds: float, pace_ms: int = 50) -> None:
        """Drag to and fro without a pause."""
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
        """Press the pad about where these activations are."""
        box = self.page.locator(".play-pad canvas").bounding_box()
        self.page.mouse.click(box["x"] + (0.12 + 0.85 * ct) * box["width"], box["y"] + (0.9 - 0.8 * ta) * box["height"])

    def gaps(self) -> int:
        return self.page.evaluate(BUFFER)["gaps"]

    def tape(self) -> np.ndarray:
        answer = self.page.evaluate(READ)
        assert np.all(np.diff(answer["frames"]) == QUANTUM), "the tape has every sample"
        return np.frombuffer(base64.b64decode(answer["text"]), "<f4").astype(float)

    def value(self, muscle: str) -> float:
        return float(self.here.slider(f"activation.{muscle}").input_value())


@pytest.fixture
def played(visit):
    # The tape's worklet is no file of the server's: only here may the page load such a script.
    return Played(visit(init=TAPE, bypass_csp=True))


def without_gaps(played: Played, watch: Watch) -> None:
    """The worklet never ran dry; a machine that stood still meanwhile proves nothing."""
    gaps = played.gaps()
    if gaps and watch.longest_s > STANDS_STILL_S:
        pytest.skip(f"{gaps} gaps, but this machine let threads wait for {1e3 * watch.longest_s:.0f} ms")
    assert gaps == 0, f"threads waited for at most {1e3 * watch.longest_s:.0f} ms"


def computed_hz(ct: float) -> float:
    """Pitch of the still voice."""
    return vfcore.simulate(vfcore.Simulation(activation=vfcore.Activation(ct=ct))).report.measures["fo_hz"].value


def quietest(sound: np.ndarray) -> float:
    """The smallest peak within any 20 ms."""
    whole = sound[: len(sound) // 960 * 960].reshape(-1, 960)
    return float(np.abs(whole).max(axis=1).min())


def test_sound_goes_on_and_follows_slider_keyboard_and_pad(played, capsys):
    with Watch() as watch:
        played.start()
        begin = played.at()
        played.drag("activation.ct", 0.1)
        low = played.hold(0.7)
        started_at = played.value("ct")
        played.here.slider("activation.ct").focus()
        for _ in range(8):
            played.page.keyboard.press("Shift+ArrowRight")
        high = played.hold(0.7)
        assert played.value("ct") == pytest.approx(started_at + 0.8, abs=0.001)
        wanted = [computed_hz(ct) for ct in (started_at, started_at + 0.8)]
        played.pad(0.3, 0.8)
        thick = played.hold(0.7)
        assert (played.value("ct"), played.value("ta")) == pytest.approx((0.3, 0.8), abs=0.1)
        played.page.locator(".play-pad").focus()
        for _ in range(3):
            played.page.keyboard.press("Shift+ArrowRight")
        assert played.value("ct") == pytest.approx(0.6, abs=0.1)
        played.page.evaluate("performance.clearMeasures()")
        played.sway("activation.ct", 3)
        end = played.at()
        times = played.page.evaluate("performance.getEntriesByName('slider to sound').map((e) => e.duration)")
        last = played.hold(0.5)
        shown = float(played.page.locator(".play-now").inner_text().split(" Hz")[0])
        sound = played.tape()
    pitches = [pitch_hz(sound[part], RATE) for part in (low, high, thick)]
    p50, p95 = np.percentile(times, [50, 95])
    with capsys.disabled():
        print(f"\nslider to sound: {len(times)} movements, p50 {p50:.0f} ms, p95 {p95:.0f} ms, max {max(times):.0f} ms")
    assert np.abs(sound).max() > 0.02
    assert pitches[1] > pitches[0] + 30, "CT is the pitch muscle"
    assert pitches[:2] == pytest.approx(wanted, rel=0.01), "it is the model's pitch"
    assert shown == pytest.approx(pitch_hz(sound[last], RATE), rel=0.01), "the page says what sounds"
    assert len(times) > 20 and p95 < 1000, "a busy machine may be slow, but nothing piles up"
    without_gaps(played, watch)
    assert quietest(sound[begin:end]) > 0.2 * np.abs(sound).max(), "never silent for 20 ms"


def test_p_starts_and_stops_and_the_help_says_so(played):
    played.page.keyboard.press("?")
    assert "play live" in played.page.get_by_role("dialog").inner_text()
    played.page.keyboard.press("Escape")
    played.page.locator("dialog").wait_for(state="detached")
    played.page.keyboard.press("p")
    played.sounding()
    played.page.keyboard.press("2")
    played.page.locator("#control-activation-ct:focus").wait_for()
    played.page.keyboard.press("End")
    rising = played.hold(0.4)
    played.page.keyboard.press("p")
    played.page.get_by_role("button", name="Play live").wait_for()
    played.page.wait_for_timeout(200)
    sound = played.tape()
    assert pitch_hz(sound[rising], RATE) > 170
    assert np.abs(sound[-QUANTUM:]).max() < 0.01, "it was faded out, not cut"


def test_a_gesture_is_recorded_and_its_sound_is_kept(played):
    played.start()
    played.page.get_by_role("button", name="Record").click()
    played.drag("activation.ct", 0.8)
    played.page.wait_for_timeout(500)
    played.page.get_by_role("button", name="Recording").click()
    with played.page.expect_download() as download:
        played.page.get_by_role("button", name="Sound", exact=True).click()
    assert download.value.path().stat().st_size > 0.5 * RATE * 2


def test_on_a_phone_it_plays_under_the_stage(visit):
    phone = Played(visit(viewport=PHONE, has_touch=True, init=TAPE, bypass_csp=True)).start()
    phone.pad(0.9, 0.2)
    part = phone.hold(0.4)
    assert pitch_hz(phone.tape()[part], RATE) > 165
    assert phone.page.get_by_role("button", name="Record").is_visible(), "buttons say what they do"
    assert phone.page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]


@pytest.mark.slow
def test_a_minute_without_a_gap(played):
    with Watch() as watch:
        played.start()
        begin = played.at()
        for muscle in ("ct", "ta", "lca", "ia"):
            played.sway(f"activation.{muscle}", 15)
            played.here.slider(f"activation.{muscle}").dblclick()
        without_gaps(played, watch)
        sound = played.tape()[begin:]
    assert len(sound) > 60 * RATE
    assert np.abs(sound).max() > 0.02
