"""The compiled loops of the measures against their numpy twins."""

import numpy as np
import pytest

from tests.support import measures_twin as twin
from vfcore.kernels import cycles
from vfcore.kernels.cepstrum import mean_prominence, relative_power, windowed_frames
from vfcore.kernels.harmonics import first_two
from vfcore.kernels.level import rms_about_mean
from vfcore.kernels.repetition import maxima, normalise, vertex
from vfcore.kernels.slope import gaussian_slope

pytestmark = pytest.mark.kernel
CLOSED, FLANK = 1e-3, 0.01


def rng(seed):
    return np.random.default_rng(seed)


def glottis(kind: str) -> tuple[np.ndarray, np.ndarray]:
    """An area wave and bounds of its cycles, at the minima or, with ``anywhere``, at random samples."""
    t = np.arange(1500)
    phase = t / 61.3 + 0.02 * np.sin(t / 300.0)
    pulse = np.sin(2 * np.pi * phase)
    area = {
        "closing": np.maximum(pulse, 0.0),
        "abrupt": np.where(pulse > 0.2, pulse, 0.0),
        "clipped": np.clip(pulse, 0.0, 0.8),
        "open": 2.0 + pulse,
        "leaking": np.maximum(pulse, 0.0) + 2e-3 * (np.mod(phase, 3.0) < 1.0),
        "twice": np.maximum(np.sin(4 * np.pi * phase), 0.0) * (1.2 + pulse),
        "noise": np.maximum(rng(5).normal(size=t.size), 0.0),
        "anywhere": np.maximum(pulse, 0.0),
    }[kind]
    bounds = np.arange(40, 1460, 61) if kind != "anywhere" else np.cumsum(rng(6).integers(33, 90, 20)) + 10
    return area, bounds


def largest_of(wave, bounds):
    return np.array([wave[a:b].max() for a, b in zip(bounds[:-1], bounds[1:], strict=True)])


@pytest.mark.parametrize("kind", ["closing", "abrupt", "clipped", "open", "leaking", "twice", "noise", "anywhere"])
def test_open_phases_are_those_of_the_twin(kind):
    """Tolerance 1e-11 of a sample: rounding of times of about 10³ samples."""
    area, bounds = glottis(kind)
    largest_at = np.empty(len(bounds) - 1, dtype=np.int64)
    cycles.first_reached(area, bounds, largest_of(area, bounds), largest_at)
    assert np.array_equal(largest_at, twin.where_largest(area, bounds))
    phases = np.full((4, len(largest_at)), np.nan)
    cycles.open_phases(area, bounds, largest_at, CLOSED, FLANK, phases)
    expected = twin.open_phases(area, bounds, largest_at, CLOSED, FLANK)
    np.testing.assert_allclose(phases, expected, rtol=0, atol=1e-11)


def test_the_time_above_a_level_is_that_of_the_twin():
    area, bounds = glottis("anywhere")
    area = np.round(8 * area)  # some lie at the level itself
    shares = np.empty(len(bounds) - 1)
    cycles.time_above(area, bounds, 0.25 * largest_of(area, bounds), shares)
    assert np.array_equal(shares, twin.time_above(area, bounds, 0.25))


def test_the_lowest_samples_and_their_refinement_are_those_of_the_twin():
    wave = np.round(rng(2).normal(size=300), 1)  # ties: the first counts
    places = np.array([0, 3, 50, 51, 140, 296, 299])
    found, between = np.empty(len(places), dtype=np.int64), np.empty(len(places))
    cycles.lowest_each(wave, places, 7, found)
    assert np.array_equal(found, twin.lowest_near(wave, places, 7))
    cycles.refined_each(wave, found, between)
    np.testing.assert_allclose(between, twin.refined(wave, found), rtol=0, atol=1e-12)


@pytest.mark.parametrize("distance", [1, 2, 7, 40])
@pytest.mark.parametrize("count", [3, 50, 400])
def test_minima_apart_from_each_other_are_those_of_the_twin(count, distance):
    wave = rng(count).normal(size=count)
    wave[20:24] = -9.0  # flat, and the lowest of all
    places = np.empty(count // 2, dtype=np.int64)
    found = cycles.spaced_minima(wave, distance, places)
    assert np.array_equal(np.sort(places[:found]), twin.spaced_minima(wave, distance))


@pytest.mark.parametrize("count", [16, 61, 300])
def test_repetition_and_its_maxima_are_those_of_the_twin(count):
    """Tolerance 1e-12: rounding of sums of a few hundred products, some updated by subtraction."""
    wave = np.sin(np.arange(count) / 0.7) + 0.3 * rng(count).normal(size=count)
    x = wave - wave.mean()
    values = np.array([(x[: count - lag] * x[lag:]).sum() for lag in range(count // 2 + 2)])
    normalise(x, values)
    np.testing.assert_allclose(values, twin.repetition(wave), rtol=0, atol=1e-12)
    for lag_max in (count // 3, count):
        lags, heights = np.empty((2, len(values) // 2 + 1))
        found = maxima(values, 2, lag_max, 0.1, lags, heights)
        right = twin.maxima(values, 2, lag_max, 0.1)
        assert found == len(right[0]) > 0
        np.testing.assert_allclose((lags[:found], heights[:found]), right, rtol=0, atol=1e-12)


def test_the_maximum_of_a_flat_top_is_its_first_sample():
    lags, heights = np.empty((2, 4))
    assert maxima(np.array([1.0, 0.0, 0.5, 0.5, 0.2, 0.0]), 1, 4, 0.1, lags, heights) == 1
    assert (lags[0], heights[0]) == (2.5, 0.5625)


def test_the_vertex_is_that_of_the_twin():
    points = rng(7).normal(size=(200, 3))
    points[:20, 2] = points[:20, 0] = points[:20, 1] - 1.0
    points[20:30] = 0.5
    for one, offset, height in zip(points, *twin.vertex(*points.T), strict=True):
        assert vertex(*one.tolist()) == pytest.approx((offset, height), rel=0, abs=1e-12)


@pytest.mark.parametrize(("begin", "count"), [(0, 200), (0, 20), (40, 100), (183, 17), (12, 2)])
def test_the_slope_is_that_of_the_twin(begin, count):
    wave, slope = rng(1).normal(size=200), np.full(count, np.nan)
    gaussian_slope(wave, begin, 1.55, 9, slope)
    np.testing.assert_allclose(slope, twin.gaussian_slope(wave, 1.55, 9)[begin : begin + count], rtol=0, atol=1e-13)


@pytest.mark.parametrize("count", [16, 143, 144, 1000])
def test_the_first_two_harmonics_are_those_of_the_twin(count):
    wave, window = 3.0 + rng(count).normal(size=count), np.hanning(count)
    found = first_two(wave, window, 0.21, np.empty((4, int(count**0.5) + 1)))
    np.testing.assert_allclose(found, twin.first_two(wave, window, 0.21), rtol=1e-10)


@pytest.mark.parametrize("count", [1, 2, 257])
def test_the_root_mean_square_is_about_the_mean(count):
    wave = 7.0 + rng(count).normal(size=count)
    assert rms_about_mean(wave) == pytest.approx(wave.std(), rel=1e-12, abs=1e-14)


def test_frames_of_the_cepstrum_are_those_of_the_twin():
    wave, window, frames = 2.0 + rng(3).normal(size=100), np.hamming(32), np.full((5, 36), 9.0)
    windowed_frames(wave, window, 17, frames)
    np.testing.assert_allclose(frames[:, :32], twin.windowed_frames(wave, window, 17), rtol=0, atol=1e-14)
    assert (frames[:, 32:] == 9.0).all()


def test_the_power_is_relative_to_each_frame_and_has_a_floor():
    spectrum = np.fft.rfft(rng(4).normal(size=(3, 60)) * [[1.0], [1e3], [1e-3]], axis=1)
    power = np.empty((3, 20))
    assert relative_power(spectrum, 0.05, power)
    np.testing.assert_allclose(power, twin.relative_power(spectrum, 0.05, 20), rtol=1e-12)
    assert (power == 0.05).any()


def test_a_silent_frame_is_reported():
    spectrum = np.ones((3, 4), complex)
    spectrum[1] = 0.0
    assert not relative_power(spectrum, 1e-14, np.empty((3, 4)))


def test_the_prominence_is_that_of_the_twin():
    cepstrum = rng(5).normal(size=(4, 90)) - np.linspace(0, 9, 90)
    expected = twin.mean_prominence(cepstrum, 11, 20, 70)
    assert mean_prominence(cepstrum, 11, 20, 70) == pytest.approx(expected, rel=1e-12)
