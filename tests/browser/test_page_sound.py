"""The sound of the voice: after a user gesture, at the right pitch, without clicks, and not too loud."""

import wave
from io import BytesIO

import numpy as np
import pytest

#: Counts audio contexts, and taps whatever is sent to a loudspeaker.
TAP = """
window.taps = [];
const connect = AudioNode.prototype.connect;
AudioNode.prototype.connect = function (target, ...rest) {
  if (target === this.context.destination) {
    const analyser = this.context.createAnalyser();
    analyser.fftSize = 16384;
    connect.call(this, analyser);
    window.taps.push(analyser);
  }
  return connect.call(this, target, ...rest);
};
"""
TAPPED = """() => {
  const samples = new Float32Array(16384);
  window.taps[0].getFloatTimeDomainData(samples);
  return { rate: window.taps[0].context.sampleRate, samples: Array.from(samples) };
}"""


def pitch_hz(samples: np.ndarray, rate: float) -> float:
    """By the highest autocorrelation between 60 and 400 Hz, refined by a parabola."""
    x = samples - samples.mean()
    spectrum = np.abs(np.fft.rfft(x, 2 * len(x))) ** 2
    r = np.fft.irfft(spectrum)[: len(x)] / np.arange(len(x), 0, -1)
    low, high = int(rate / 400), int(rate / 60)
    k = low + int(np.argmax(r[low:high] > 0.97 * r[low:high].max()))
    k = k - 3 + int(np.argmax(r[k - 3 : k + 12]))
    a, b, c = r[k - 1 : k + 2]
    return rate / (k + 0.5 * (a - c) / (a - 2 * b + c))


def unlike_itself(samples: np.ndarray, period: float) -> float:
    """Rms difference between the wave and itself one period later, over its rms."""
    later = np.interp(np.arange(len(samples) - 400) + period, np.arange(len(samples)), samples)
    first = samples[: len(later)]
    return float(np.sqrt(np.mean((later - first) ** 2) / np.mean(first**2)))


def tapped(here) -> tuple[np.ndarray, float]:
    here.page.wait_for_timeout(900)
    answer = here.page.evaluate(TAPPED)
    return np.array(answer["samples"]), answer["rate"]


def fo_hz(here) -> float:
    return here.api(f"jobs/{here.result_id()}/result")["measures"]["fo_hz"]["value"]


def test_nothing_sounds_before_a_user_gesture_then_the_voice_at_its_pitch_and_a_modest_level(visit):
    here = visit(init=TAP)
    assert here.page.evaluate("window.taps.length") == 0
    here.page.get_by_role("button", name="Listen").click()
    samples, rate = tapped(here)
    assert 0.01 < np.abs(samples).max() < 0.5, "audible, and modest before the volume is touched"
    assert pitch_hz(samples, rate) == pytest.approx(fo_hz(here), rel=0.005)
    assert unlike_itself(samples, rate / fo_hz(here)) < 0.05, "no jump where the loop begins again"


def test_the_sound_follows_the_controls_and_stops_with_the_phonation(visit):
    here = visit(init=TAP)
    here.page.keyboard.press("Space")
    low, _ = tapped(here)
    here.set("activation.ct", 1)
    samples, rate = tapped(here)
    assert pitch_hz(samples, rate) == pytest.approx(fo_hz(here), rel=0.005)
    assert pitch_hz(samples, rate) > pitch_hz(low, rate) + 20
    here.page.get_by_label("Voice").select_option("no_phonation")
    here.settle()
    assert here.state() == "No sustained vibration"
    assert np.abs(tapped(here)[0]).max() == 0
    here.page.get_by_label("Voice").select_option("modal")
    here.settle()
    assert np.abs(tapped(here)[0]).max() > 0.01, "it comes back by itself"
    here.page.keyboard.press("Space")
    assert np.abs(tapped(here)[0]).max() == 0


def test_the_volume_slider_turns_it_down(visit):
    here = visit(init=TAP)
    here.page.get_by_role("button", name="Listen").click()
    loud, _ = tapped(here)
    here.page.get_by_label("Volume").fill("0.1")
    soft, _ = tapped(here)
    assert np.abs(soft).max() < 0.1 * np.abs(loud).max()


def test_without_repeat_the_run_sounds_once(visit):
    here = visit(init=TAP)
    here.page.get_by_role("button", name="Repeat").click()
    here.page.get_by_role("button", name="Listen").click()
    here.page.get_by_role("button", name="Stop", exact=True).wait_for()
    here.page.get_by_role("button", name="Listen").wait_for(timeout=3000)
    assert np.abs(tapped(here)[0]).max() == 0


def test_the_sound_can_be_saved_as_a_file(visit):
    here = visit()
    with here.page.expect_download() as download:
        here.page.get_by_role("link", name="Download").click()
    with wave.open(BytesIO(download.value.path().read_bytes())) as file:
        rate, count = file.getframerate(), file.getnframes()
        samples = np.frombuffer(file.readframes(count), dtype="<i2") / 32768
    assert (rate, count) == (48000, 24000)
    assert pitch_hz(samples[count // 2 :], rate) == pytest.approx(fo_hz(here), rel=0.005)


OFFLINE = """async ([first, second, rate]) => {
  const { LoopPlayer } = await import("/features/sound/loop-player.js");
  const context = new OfflineAudioContext(1, rate, rate);
  const voice = new LoopPlayer(context);
  voice.play(new Float32Array(first));
  context.suspend(0.5).then(() => { voice.play(new Float32Array(second)); context.resume(); });
  return Array.from((await context.startRendering()).getChannelData(0));
}"""


def sine(hertz: float, peak_pa: float, rate: int = 48000, periods: int = 30) -> list[float]:
    count = round(periods * rate / hertz)
    return (peak_pa * np.sin(2 * np.pi * periods * np.arange(count) / count)).tolist()


def test_the_change_of_voice_is_a_crossfade_without_a_jump(modules):
    out = np.array(modules(OFFLINE, [sine(150, 400), sine(190, 500), 48000]))
    steps = np.abs(np.diff(out))
    steady = max(steps[12000:20000].max(), steps[32000:].max())
    assert out[12000:20000].max() == pytest.approx(400 / 2000, rel=0.02)
    assert out[32000:].max() == pytest.approx(500 / 2000, rel=0.02)
    assert steps.max() < 1.1 * steady


def test_a_voice_that_is_far_too_loud_is_held_below_full_scale(modules):
    out = np.array(modules(OFFLINE, [sine(150, 400), sine(150, 7000), 48000]))
    assert 0.9 < np.abs(out).max() < 0.97


LOOP = """async ([wave, rate, period, periodic, out]) => {
  const { makeLoop } = await import("/features/sound/loop.js");
  return Array.from(makeLoop(new Float32Array(wave), rate, { periodS: period, periodic }, out));
}"""


@pytest.mark.parametrize("rate, out", [(28000, 48000), (28000, 44100), (560000, 48000)])
def test_a_loop_of_whole_periods_repeats_without_a_seam(modules, rate, out):
    hertz = 149.63
    t = np.arange(round(0.5 * rate)) / rate
    wave_pa = np.sin(2 * np.pi * hertz * t) + 0.5 * np.sin(2 * np.pi * 7 * hertz * t + 1)
    if rate > 80_000:
        wave_pa += np.sin(2 * np.pi * 40_000 * t)  # above the Nyquist frequency: must not alias
    loop = np.array(modules(LOOP, [wave_pa.tolist(), rate, 1 / hertz, True, out]))
    assert pitch_hz(np.tile(loop, 2), out) == pytest.approx(hertz, rel=5e-4)
    twice = np.tile(loop, 2)
    bend = np.abs(np.diff(twice, 2))
    assert bend[len(loop) - 20 : len(loop) + 20].max() < 1.02 * bend.max()
    spectrum = np.abs(np.fft.rfft(loop)) / len(loop) * 2
    lines = {round(hertz * n * len(loop) / out) for n in (1, 7)}
    assert sorted(spectrum)[-1] == pytest.approx(1, rel=0.01)
    others = [level for k, level in enumerate(spectrum) if all(abs(k - line) > 8 for line in lines)]
    assert max(others) < 2e-3, "nothing is added to the wave's own harmonics"


STREAM = """async ([pieces, rate]) => {
  const context = new OfflineAudioContext(1, rate, rate);
  await context.audioWorklet.addModule("/features/play/stream-worklet.js");
  const node = new AudioWorkletNode(context, "vocalis-stream", { numberOfInputs: 0, outputChannelCount: [1] });
  const { port1, port2 } = new MessageChannel();
  const reports = [];
  port2.onmessage = ({ data }) => reports.push(data);
  node.port.postMessage({ line: port1 }, [port1]);
  node.connect(context.destination);
  for (const [second, samples, mark] of pieces)
    context.suspend(second).then(async () => {
      port2.postMessage({ samples: new Float32Array(samples), mark: mark ?? undefined });
      await new Promise((done) => setTimeout(done, 100));
      context.resume();
    });
  const sound = Array.from((await context.startRendering()).getChannelData(0));
  await new Promise((done) => setTimeout(done, 100));
  return { sound, reports };
}"""


def test_a_buffer_underrun_fades_out_and_in_and_is_reported(modules):
    rate, seconds = 48000, 0.2
    t = np.arange(round(seconds * rate)) / rate
    first, second = (np.sin(2 * np.pi * 200 * (t + begin)).tolist() for begin in (0, seconds))
    # A message posted in one suspension of an offline context arrives in the next.
    rests = [[0.003, [], None], [0.006, first, 1], [0.01, [], None], [0.49, second, 2], [0.5, [], None]]
    answer = modules(STREAM, [rests, rate])
    sound = np.array(answer["sound"])
    assert np.abs(sound[4800:9000]).max() > 0.99
    assert np.abs(sound[round(0.25 * rate) : round(0.49 * rate)]).max() == 0, "dry"
    assert np.abs(sound[round(0.55 * rate) : round(0.65 * rate)]).max() > 0.99, "and back"
    assert np.abs(np.diff(sound)).max() < 1.3 * 2 * np.pi * 200 / rate, "without a click"
    marks = {report["mark"]: report["at"] for report in answer["reports"] if "mark" in report}
    assert marks == pytest.approx({1: 0.01, 2: 0.5}, abs=0.006), "when each marked block began to sound"
    gaps = [report["gaps"] for report in answer["reports"] if "gaps" in report]
    assert gaps[-1] == 2, "once between, once at the end"
