"""The played voice: every sample sent to the loudspeaker is recorded while controls move."""

import numpy as np
import pytest

import vfcore
from tests.browser.conftest import PHONE
from tests.browser.played import QUANTUM, RATE, TAPE, Played, Watch
from tests.browser.test_page_sound import pitch_hz

pytestmark = pytest.mark.alone

#: Largest share of missing sound on a machine that also does other work.
SILENT_SHARE = 0.05
#: Number of movements that must be audible before their delay is judged.
ENOUGH = 20


@pytest.fixture
def played(visit):
    # The recorder's worklet is not a file of the server; only these tests may load it.
    return Played(visit(init=TAPE, bypass_csp=True))


def computed_hz(ct: float) -> float:
    """Pitch of the voice at rest, from a request."""
    return vfcore.simulate(vfcore.Simulation(activation=vfcore.Activation(ct=ct))).report.measures["fo_hz"].value


def silent_share(sound: np.ndarray) -> float:
    """Share of silent pieces of 20 ms."""
    whole = sound[: len(sound) // 960 * 960].reshape(-1, 960)
    return float((np.abs(whole).max(axis=1) < 0.2 * np.abs(sound).max()).mean())


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
        for _ in range(5):  # on a busy machine fewer movements are audible in that time
            played.drag_back_and_forth("activation.ct", 3)
            times = played.page.evaluate("performance.getEntriesByName('slider to sound').map((e) => e.duration)")
            if len(times) > ENOUGH:
                break
        end = played.at()
        last = played.hold(0.5)
        shown = float(played.page.locator(".play-now").inner_text().split(" Hz")[0])
        sound = played.tape()
    pitches = [pitch_hz(sound[part], RATE) for part in (low, high, thick)]
    p50, p95 = np.percentile(times, [50, 95])
    with capsys.disabled():
        print(f"\nslider to sound: {len(times)} movements, p50 {p50:.0f} ms, p95 {p95:.0f} ms, max {max(times):.0f} ms")
        print(f"{played.gaps() + played.missing} gaps; threads waited for at most {1e3 * watch.longest_s:.0f} ms")
    assert np.abs(sound).max() > 0.02
    assert pitches[1] > pitches[0] + 30, "CT is the pitch muscle"
    assert pitches[:2] == pytest.approx(wanted, rel=0.01), "it is the model's pitch"
    assert shown == pytest.approx(pitch_hz(sound[last], RATE), rel=0.01), "the page says what sounds"
    assert len(times) > ENOUGH and p95 < 1000, "a busy machine may be slow, but nothing queues up"
    assert silent_share(sound[begin:end]) < SILENT_SHARE


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


def test_a_gesture_is_recorded_and_its_sound_is_exported(played):
    played.start()
    played.page.get_by_role("button", name="Record").click()
    played.drag("activation.ct", 0.8)
    played.page.wait_for_timeout(500)
    played.page.get_by_role("button", name="Recording").click()
    with played.page.expect_download() as download:
        played.page.get_by_role("button", name="Sound", exact=True).click()
    assert download.value.path().stat().st_size > 0.5 * RATE * 2


def test_on_a_phone_the_pad_is_under_the_folds(visit):
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
            played.drag_back_and_forth(f"activation.{muscle}", 15)
            played.here.slider(f"activation.{muscle}").dblclick()
        sound = played.tape()[begin:]
    gaps = played.gaps() + played.missing
    assert gaps == 0, f"{gaps} gaps; threads of this machine waited for at most {1e3 * watch.longest_s:.0f} ms"
    assert len(sound) > 60 * RATE
    assert np.abs(sound).max() > 0.02
