"""The phonation state: what counts as phonation, as periodic, subharmonic and irregular."""

import numpy as np
import pytest

from tests.support.synthetic_waves import MM2, RATE_HZ, alternating, signals_from, steady_phase, times, triangle
from vfcore.kernels.repetition import vertex
from vfcore.measures import measure_all
from vfcore.measures.pitch import autocorrelation, autocorrelations

RATES = [60.0, 97.3, 149.6, 233.7, 371.0, 499.7]
T = times()


def pulses(fo_hz, closed_quotient=0.5, speed_quotient=1.5):
    return 10 * MM2 * triangle(steady_phase(T, fo_hz), closed_quotient, speed_quotient)


def report(area):
    return measure_all(signals_from(area))


@pytest.mark.parametrize("fo_hz", RATES)
def test_a_repeating_wave_is_periodic(fo_hz):
    result = report(pulses(fo_hz))
    assert result.state == "periodic"
    assert result.periodicity > 0.999


@pytest.mark.parametrize("fo_hz", RATES)
def test_a_glottis_that_never_closes_can_be_periodic(fo_hz):
    result = report((40 + 4 * np.sin(2 * np.pi * fo_hz * T)) * MM2)
    assert result.state == "periodic"
    assert result.measures["fo_hz"].value == pytest.approx(fo_hz, rel=1e-4)
    assert result.measures["closed_quotient"].value == 0.0


@pytest.mark.parametrize("fo_hz", RATES)
@pytest.mark.parametrize(("place", "height", "width"), [
    (0.3, 0.5, 0.3), (0.4, 0.5, 0.3), (0.4, 0.9, 0.3), (0.5, 0.2, 0.3), (0.4, 1.0, 0.12),
])  # fmt: skip
def test_two_bumps_in_a_cycle_are_one_cycle(fo_hz, place, height, width):
    phase = steady_phase(T, fo_hz)
    result = report(10 * MM2 * (triangle(phase, 1 - width, 1.5) + height * triangle(phase - place, 1 - width, 1.5)))
    assert result.state == "periodic"
    assert result.measures["fo_hz"].value == pytest.approx(fo_hz, rel=1e-4)


@pytest.mark.parametrize("visible_hz", [97.3, 149.6, 233.7, 371.0, 499.7])
@pytest.mark.parametrize(("weaker", "count"), [(0.9, 2), (0.6, 2), (0.35, 2), (0.7, 3), (0.8, 4)])
def test_alternating_cycles_are_subharmonic_with_f_o_of_the_whole_pattern(visible_hz, weaker, count):
    result = report(pulses(visible_hz) * alternating(steady_phase(T, visible_hz), weaker, count))
    assert result.state == "subharmonic"
    assert result.measures["fo_hz"].value == pytest.approx(visible_hz / count, rel=1e-4)
    assert result.cycles % count == 0
    start, stop = result.cycle_bounds
    assert stop - start == pytest.approx(count * RATE_HZ / visible_hz, abs=0.02 * RATE_HZ / visible_hz)


@pytest.mark.parametrize("visible_hz", [60.0, 97.3, 149.6, 233.7])
@pytest.mark.parametrize(("unequal", "closed"), [(0.06, 0.7), (0.09, 0.7), (0.09, 0.9)])
def test_alternating_cycle_lengths_are_subharmonic(visible_hz, unequal, closed):
    lengths = np.where(np.arange(600) % 2, 1 + unequal, 1 - unequal) / visible_hz
    result = report(10 * MM2 * triangle(np.interp(T, np.cumsum(lengths), np.arange(600)), closed, 1.5))
    assert result.state == "subharmonic"
    assert result.measures["fo_hz"].value == pytest.approx(visible_hz / 2, rel=1e-4)


@pytest.mark.parametrize("fo_hz", RATES)
def test_an_alternation_within_the_bound_of_a_nearly_periodic_voice_is_periodic(fo_hz):
    result = report(pulses(fo_hz) * alternating(steady_phase(T, fo_hz), 0.97))
    assert result.state == "periodic"
    assert result.measures["fo_hz"].value == pytest.approx(fo_hz, rel=1e-4)


GOLDEN = (3 - np.sqrt(5)) / 2


@pytest.mark.parametrize("fo_hz", RATES)
@pytest.mark.parametrize(("depth", "rate"), [(0.1, GOLDEN), (0.3, GOLDEN), (0.6, GOLDEN), (0.3, 0.49)])
def test_a_modulation_at_an_incommensurate_rate_is_irregular(fo_hz, depth, rate):
    result = report(pulses(fo_hz) * (1 + depth * np.sin(2 * np.pi * rate * fo_hz * T)))
    assert result.state == "irregular"
    assert result.measures["fo_hz"].value == pytest.approx(fo_hz, rel=2e-4)


@pytest.mark.parametrize("offset", np.linspace(0.0, 1.0, 8))
def test_the_ends_of_the_window_add_no_cycle_to_an_irregular_voice(offset):
    modulation = 1 + 0.5 * np.sin(2 * np.pi * GOLDEN * 60 * T + 7 * offset)
    result = report(10 * MM2 * triangle(steady_phase(T, 60.0, offset), 0.5, 1.5) * modulation)
    assert result.state == "irregular"
    assert result.cycles <= 29
    assert result.measures["fo_hz"].value == pytest.approx(60.0, rel=2e-4)
    assert result.measures["closed_quotient"].value == pytest.approx(0.5005, abs=1e-3)


@pytest.mark.parametrize("fo_hz", RATES)
def test_random_cycle_lengths_are_irregular_and_counted_one_by_one(fo_hz):
    rng = np.random.default_rng(7)
    starts = np.cumsum((1 + 0.03 * rng.standard_normal(1200)) / fo_hz)
    result = report(10 * MM2 * triangle(np.interp(T, starts, np.arange(1200)), 0.5, 1.5))
    assert result.state == "irregular"
    inside = starts[(starts > 0.5) & (starts < 1.0)]
    # A cycle or two at the ends may be left out; their lengths move the mean by this much at most.
    assert result.measures["fo_hz"].value == pytest.approx(1 / np.diff(inside).mean(), rel=0.09 / len(inside) * 3)


@pytest.mark.parametrize(("noise", "state"), [(0.01, "periodic"), (0.1, "irregular")])
def test_noise_counts_by_the_same_bound(noise, state):
    rng = np.random.default_rng(3)
    result = report(np.maximum(pulses(149.6) + 10 * MM2 * noise * rng.standard_normal(len(T)), 0.0))
    assert result.state == state
    assert result.measures["fo_hz"].value == pytest.approx(149.6, rel=1e-3)


@pytest.mark.parametrize("fo_hz", RATES)
@pytest.mark.parametrize(("envelope", "word"), [
    (np.exp(-T / 0.1), "No phonation"),
    (np.exp(-T / 0.5), "dies out"),
    (np.exp(-T / 1.5), "dies out"),
    (T < 0.7, "stays closed"),
    (T < 0.8, "dies out"),
    (0.2 * np.exp(T / 0.5), "still building up"),
    (np.where(T > 0.7, 1.0, 0.3), "still building up"),
    (T > 0.6, "still building up"),
    (T > 0.8, "still building up"),
])  # fmt: skip
def test_decaying_or_growing_vibration_is_not_sustained_phonation(fo_hz, envelope, word):
    result = report(pulses(fo_hz) * envelope)
    assert result.state == "none"
    assert word in result.explanation


def test_ringing_around_an_open_glottis_is_not_phonation():
    result = report((3 + 30 * np.exp(-T / 0.15) * np.sin(2 * np.pi * 140 * T)).clip(0) * MM2)
    assert result.state == "none"
    assert "dies out" in result.explanation


@pytest.mark.parametrize("fo_hz", RATES)
def test_a_wave_that_has_come_down_to_a_plateau_is_periodic(fo_hz):
    assert report(pulses(fo_hz) * (1 + np.exp(-T / 0.1))).state == "periodic"


@pytest.mark.parametrize(("area", "word"), [
    (0 * T, "stays closed"),
    (5 * MM2 + 0 * T, "0 mm²"),
    ((5 + 0.04 * np.sin(2 * np.pi * 150 * T)) * MM2, "0.08 mm²"),
    ((100 + 2 * np.sin(2 * np.pi * 150 * T)) * MM2, "4 % of its mean"),
    (5 * MM2 * (1 + T), "does not vibrate"),
    (5 * MM2 * np.random.default_rng(0).random(len(T)), "does not vibrate"),
], ids=["closed", "open", "tiny", "shallow", "drift", "hiss"])  # fmt: skip
def test_silence_has_its_own_explanation(area, word):
    result = report(area)
    assert result.state == "none"
    assert result.periodicity is None
    assert result.cycles == 0
    assert result.cycle_bounds is None
    assert word in result.explanation


def test_a_just_audible_vibration_is_phonation():
    assert report((1 + 0.06 * np.sin(2 * np.pi * 150 * T)) * MM2).state == "periodic"


def test_a_run_too_short_to_judge_says_so():
    result = measure_all(signals_from(pulses(150.0)[:5000]))
    assert result.state == "none"
    assert "71 ms" in result.explanation


@pytest.mark.parametrize("fo_hz", [97.3, 233.7])
@pytest.mark.parametrize("rate_hz", [20_000.0, 44_100.0])
def test_the_state_does_not_depend_on_the_sample_rate(fo_hz, rate_hz):
    t = times(0.6, rate_hz)
    area = 10 * MM2 * triangle(steady_phase(t, fo_hz), 0.5, 1.5)
    result = measure_all(signals_from(area, rate_hz))
    assert result.state == "periodic"
    assert result.measures["fo_hz"].value == pytest.approx(fo_hz, rel=1e-4)


def test_the_vertex_of_a_nearly_straight_rise_is_kept_at_half_a_sample():
    """The parabola's own extremum is then 10¹⁵ samples away."""
    offset, height = vertex(-1.0, 0.0, np.nextafter(1.0, 0.0))
    assert offset == 0.5
    assert height == pytest.approx(0.25)


def test_several_waves_at_once_repeat_like_each_alone():
    """Bit for bit in double precision; in single precision r to a few roundings, the period to much less than a
    sample.
    """
    waves = np.stack([pulses(fo_hz)[:9001] for fo_hz in (97.3, 149.6, 371.0, 499.7)])
    single = autocorrelations(waves.astype(np.float32))
    for wave, double, coarse in zip(waves, autocorrelations(waves), single, strict=True):
        alone = autocorrelation(wave)
        assert np.array_equal(double.values, alone.values)
        np.testing.assert_allclose(coarse.values, alone.values, rtol=0, atol=3e-6)
        (peak, *_), (expected, *_) = coarse.peaks(28, 3000), alone.peaks(28, 3000)
        assert coarse.long_term_period(peak.lag) == pytest.approx(alone.long_term_period(expected.lag), rel=1e-6)
