"""The period by direct sums against the same by FFTs."""

import numpy as np
import pytest

from vfcore.kernels.repetition import first_period, likeness
from vfcore.measures.pitch import PEAK_RISE, autocorrelation

pytestmark = pytest.mark.kernel
LEAST, NEARLY = 0.5, 0.95


def twin(wave: np.ndarray, lag_min: int) -> float:
    peaks = autocorrelation(wave).peaks(lag_min, len(wave) // 2)
    highest = max((peak.height for peak in peaks), default=0.0)
    if highest < LEAST:
        return float("nan")
    return next(peak.lag for peak in peaks if peak.height >= NEARLY * highest)


def period(values: np.ndarray, rise: float) -> float:
    return first_period(values, 2, rise, LEAST, NEARLY, *np.empty((2, len(values) // 2 + 1)))


def test_likeness_and_period_are_those_of_the_fft():
    """Tolerance 1e-12: rounding of sums of a few hundred products."""
    rng, found = np.random.default_rng(4), []
    for count in (4, 30, 61, 150, 211):
        for noise in (0.0, 0.2, 3.0):
            t = np.arange(count)
            wave = 1.0 + np.maximum(0.0, np.sin(t / rng.uniform(2.0, 9.0))) + noise * rng.random(count)
            values = np.empty(count // 2 + 2)
            likeness(wave, np.empty(count), values)
            np.testing.assert_allclose(values, autocorrelation(wave).values, rtol=0, atol=1e-12)
            lag = period(values, PEAK_RISE)
            assert lag == pytest.approx(twin(wave, 2), rel=1e-12, nan_ok=True)
            found.append(np.isnan(lag))
    assert 2 < sum(found) < len(found) - 2, "the cases must include waves with and without a period"


def test_a_constant_wave_has_no_likeness_and_no_period():
    values = np.empty(12)
    likeness(np.full(20, 3.0), np.empty(20), values)
    assert not values.any()


def test_a_ripple_on_the_way_down_from_lag_0_is_no_period():
    t = np.arange(300)
    wave = np.sin(2 * np.pi * t / 100) + 0.2 * np.sin(2 * np.pi * t / 4)
    values = np.empty(152)
    likeness(wave, np.empty(300), values)
    assert period(values, 0.0) < 10
    assert period(values, PEAK_RISE) == pytest.approx(100, rel=0.05)
