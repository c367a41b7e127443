"""A voice whose muscles move: equal to a simulation when nothing moves, no discontinuity, pitch follows CT."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import vfcore
import vfcore.runs.gesture.glide
from vfcore.airways.impulse_response import radiate
from vfcore.airways.tract import vowel_tract
from vfcore.errors import Cancelled, DivergenceError, ParameterError
from vfcore.io.audio import AUDIO_RATE_HZ
from vfcore.io.audio import render as resampled
from vfcore.runs.gesture.gesture import gesture_from_dict
from vfcore.runs.gesture.render import RATE_HZ, render
from vfcore.runs.gesture.slew import slew_limited
from vfcore.runs.gesture.voice import BLOCK_S, BLOCK_STEPS, Voice
from vfcore.spec.request import resolve


def glide(seconds=1.2, **activation):
    return render(gesture_from_dict({"activation": activation, "run": {"duration_s": seconds}}))


@pytest.fixture(scope="module")
def rising():
    return glide(1.6, ct=[[0.3, 0.1], [1.3, 0.9]])


def test_a_constant_gesture_equals_the_simulation():
    still, plain = glide(0.3), vfcore.simulate(vfcore.Simulation(run=vfcore.Run(duration_s=0.3)))
    for name in ("glottal_area_m2", "glottal_flow_m3_s", "contact_pressure_max_pa"):
        assert np.array_equal(still.waves[name], plain.arrays[name]), name


def test_the_tract_in_blocks_equals_the_tract_over_the_whole_flow(rising):
    whole = radiate(rising.waves["glottal_flow_m3_s"], 1 / RATE_HZ, vowel_tract("a"))
    for name, expected in (
        ("radiated_pressure_pa", whole.lip_pressure_pa),
        ("far_pressure_pa", whole.far_pressure_pa),
    ):
        assert np.abs(rising.waves[name] - expected).max() < 3e-3 * np.abs(expected).max()


def test_the_audio_in_blocks_equals_the_audio_of_the_whole_sound(rising):
    whole = resampled(rising.waves["radiated_pressure_pa"], RATE_HZ)
    late = rising.audio_delay_s * AUDIO_RATE_HZ
    at = np.arange(len(rising.audio_pa)) - late
    inside = (at > 0) & (at < len(whole) - 1)
    expected = CubicSpline(np.arange(len(whole)), whole)(at)
    assert np.abs(rising.audio_pa - expected)[inside].max() < 0.003 * np.abs(whole).max()


def test_f_o_rises_with_ct_to_that_of_a_constant_voice(rising):
    fo, times = rising.contours["fo_hz"], rising.contours["time_s"]
    moving = (times > 0.35) & (times < 1.25)
    assert np.isfinite(fo[moving]).all()
    assert (np.diff(fo[moving]) > 0).mean() > 0.95
    alone = vfcore.simulate(vfcore.Simulation(activation=vfcore.Activation(ct=0.9)))
    assert fo[times > 1.45] == pytest.approx(alone.report.measures["fo_hz"].value, rel=2e-3)


def test_each_segment_between_breakpoints_is_measured(rising):
    first, second, last = rising.segments
    assert (first.end_s, second.end_s, last.end_s) == (0.3, 1.3, 1.6)
    assert first.report.state == last.report.state == "periodic"
    rise = last.report.measures["fo_hz"].value - first.report.measures["fo_hz"].value
    assert rise == pytest.approx(52, abs=3)


def test_shorter_stretches_change_nothing_audible(monkeypatch):
    """In the fastest glide the difference is at most −38 dB during the glide and −60 dB after it."""
    ct = [[0.2, 0.1], [0.25, 0.9]]
    sound = glide(0.4, ct=ct).waves["radiated_pressure_pa"]
    monkeypatch.setattr(vfcore.runs.gesture.glide, "STRETCH_STEPS", 2)
    finer = glide(0.4, ct=ct).waves["radiated_pressure_pa"]
    during, after = slice(round(0.2 * RATE_HZ), round(0.25 * RATE_HZ)), slice(round(0.27 * RATE_HZ), None)
    for part, least in ((during, -38.0), (after, -60.0)):
        assert 20 * np.log10(np.std((finer - sound)[part]) / np.std(sound[part])) < least


def test_a_new_vowel_makes_no_click():
    voice = Voice(vfcore.Simulation())
    sound = [voice.advance(vfcore.Simulation(vowel="a" if k < 30 else "i")).lip_pressure_pa for k in range(60)]
    sound = np.concatenate(sound)
    at = 30 * BLOCK_STEPS
    step = np.abs(np.diff(sound))
    assert step[at - 10 : at + BLOCK_STEPS + 10].max() < 1.5 * max(step[at // 2 : at].max(), step[at * 3 // 2 :].max())


def test_a_jump_of_a_parameter_makes_no_click():
    """The sound after the jump is no steeper than in a slow glide over the same range."""

    def steepest(blocks_of_motion: int) -> float:
        voice, sound = Voice(vfcore.Simulation(activation=vfcore.Activation(ct=0.1))), []
        for k in range(30 + blocks_of_motion + 30):
            share = min(1.0, max(0.0, (k - 29) / blocks_of_motion))
            goal = vfcore.Simulation(activation=vfcore.Activation(ct=0.1 + 0.8 * share))
            sound.append(voice.advance(slew_limited(voice.request, goal, ("activation.ct",))).audio_pa)
        assert voice.request.activation.ct == pytest.approx(0.9)
        return float(np.abs(np.diff(np.concatenate(sound[15:]))).max())

    assert steepest(1) < 1.3 * steepest(60)


FORMS = {
    "two walls": {"right": {"activation": {"ta": 0.39}}},
    "lesion": {"lesions": [{"kind": "custom", "length_mm": 8, "width_mm": 4, "stiffness_ratio": 1.02}]},
    "both": {"lesions": [{"kind": "custom", "side": "left", "length_mm": 8, "width_mm": 4, "stiffness_ratio": 1.02}]},
}


@pytest.mark.parametrize("coupling", ["one_way", "two_way"])
@pytest.mark.parametrize("change", FORMS.values(), ids=FORMS)
def test_the_sound_goes_on_when_the_folds_begin_to_differ_or_get_a_lesion(change, coupling):
    """A slight change leads to another form of the step: the sound is as steep as before, and stays that of a voice
    in which the change was there from the beginning of the same block.
    """
    base = {"model": {"variant": "human", "coupling": coupling}, "subglottal_pressure_pa": 800}
    plain, changed = resolve(base), resolve(base | change)
    voice = Voice(plain)
    before = [voice.advance(plain) for _ in range(30)]
    form = voice.form
    after = [voice.advance(changed) for _ in range(30)]
    assert voice.form != form and voice.form == form.covering(voice.form)
    for column in (0, 1):  # area and flow
        wave = np.concatenate([block.record[:, column] for block in before + after])
        slope = np.abs(np.diff(wave))
        at = 30 * BLOCK_STEPS
        assert slope[at - 5 : at + 2 * BLOCK_STEPS].max() < 1.1 * slope[at // 2 : at].max()
    sound = np.concatenate([block.audio_pa for block in before + after])
    steep, at = np.abs(np.diff(sound, 2)), 30 * len(before[0].audio_pa)
    assert steep[at - 10 : at + 1000].max() < 1.1 * steep[at // 2 : at].max()


def test_a_change_of_form_alone_leaves_the_motion():
    """Two walls that differ by a billionth in TA move as the one fold did, to a millionth of the flow, for 20 ms."""
    plain = vfcore.Simulation()
    split = resolve({"right": {"activation": {"ta": plain.activation.ta + 1e-9}}})
    one, two = Voice(plain), Voice(plain)
    for _ in range(20):
        one.advance(plain)
        two.advance(plain)
    for _ in range(2):
        here, there = one.advance(plain).record, two.advance(split).record
        assert np.abs(here[:, :2] - there[:, :2]).max() < 1e-6 * here[:, 1].max()
    assert (one.form.walls, two.form.walls) == (1, 2)
    assert len(two.glottis.walls) == 2 and two.seen[0].shape[0] == 2


def test_the_voice_stops_and_starts_as_the_pressure_does():
    rendered = render(
        gesture_from_dict(
            {
                "subglottal_pressure_pa": [[0.3, 1000.0], [0.35, 0.0], [0.7, 0.0], [0.75, 1000.0]],
                "run": {"duration_s": 1.4},
            }
        )
    )
    fo, times = rendered.contours["fo_hz"], rendered.contours["time_s"]
    assert np.isnan(fo[(times > 0.55) & (times < 0.7)]).all()
    assert np.isfinite(fo[times > 1.1]).all()


def test_parameters_that_cannot_move_are_refused():
    voice = Voice(vfcore.Simulation())
    with pytest.raises(ParameterError, match="model: cannot change once the voice has begun"):
        voice.advance(vfcore.Simulation(model=vfcore.Model(variant="text_literal")))
    with pytest.raises(ParameterError, match="run: cannot change once the voice has begun"):
        voice.advance(vfcore.Simulation(run=vfcore.Run(nx=30)))
    with pytest.raises(ParameterError, match="need a shorter step"):
        Voice(vfcore.Simulation(run=vfcore.Run(ny=40)))


def test_a_divergence_has_its_time():
    voice = Voice(vfcore.Simulation())
    voice._gliding._march.buffer[:] *= np.nan
    with pytest.raises(DivergenceError, match="t = 10.000 ms"):
        voice.advance(vfcore.Simulation())


def test_a_stop_ends_it():
    with pytest.raises(Cancelled):
        render(gesture_from_dict({}), stop=lambda: True)


def test_blocks_are_ten_milliseconds():
    block = Voice(vfcore.Simulation()).advance(vfcore.Simulation())
    assert BLOCK_S == pytest.approx(0.010, rel=1e-12)
    assert (len(block.record), len(block.lip_pressure_pa), len(block.audio_pa)) == (280, 280, 480)
