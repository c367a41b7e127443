"""f_o and level of short windows: exact on known waves, NaN without vibration or sound."""

from functools import partial

import numpy as np
import pytest

from vfcore.runs.gesture.contours import WINDOW_S, contour, level_db, pitch_hz

RATE = 35_000.0
AREA_M2 = 10e-6


def pulses(hertz, seconds: float = WINDOW_S, every_second: float = 1.0) -> np.ndarray:
    """Rectified cosine like an area; ``hertz`` a number or (n,); each second pulse times ``every_second``."""
    n = round(seconds * RATE)
    cycles = np.cumsum(np.broadcast_to(hertz, n)) / RATE
    high = np.where(np.floor(cycles) % 2 == 1, every_second, 1.0)
    return AREA_M2 * high * np.maximum(0.0, -np.cos(2 * np.pi * cycles))


@pytest.mark.parametrize("hertz", [75.0, 149.63, 210.4, 400.0])
def test_pitch_of_a_steady_wave(hertz):
    assert pitch_hz(pulses(hertz), RATE) == pytest.approx(hertz, rel=2e-4)
    assert pitch_hz(pulses(hertz)[::4], RATE / 4) == pytest.approx(hertz, rel=2e-3)  # as the live strobe reads it


def test_a_slightly_alternating_wave_keeps_its_pitch_and_a_strongly_alternating_one_is_an_octave_lower():
    assert pitch_hz(pulses(150.0, every_second=0.97), RATE) == pytest.approx(150.0, rel=1e-3)
    assert pitch_hz(pulses(150.0, every_second=0.4), RATE) == pytest.approx(75.0, rel=1e-3)


@pytest.mark.parametrize(
    "area",
    [np.zeros(0), np.zeros(2100), np.full(2100, AREA_M2), 1e-15 * pulses(150.0)],
    ids=["no samples", "closed", "open and still", "too small to hear"],
)
def test_no_pitch_where_nothing_vibrates(area):
    assert np.isnan(pitch_hz(area, RATE))


def test_noise_has_no_pitch():
    assert np.isnan(pitch_hz(AREA_M2 * np.random.default_rng(1).random(2100), RATE))


def test_level_of_a_sine_of_one_pascal():
    t = np.arange(2100) / RATE
    assert level_db(np.sin(2 * np.pi * 500 * t) + 3.0) == pytest.approx(90.97, abs=0.01), (
        "a steady pressure is no sound"
    )
    assert np.isnan(level_db(np.zeros(0))) and np.isnan(level_db(np.zeros(2100)))


def test_a_contour_follows_a_glide_and_ends_are_cut_short():
    hertz = np.linspace(120.0, 180.0, round(RATE))
    times = np.array([0.0, 0.25, 0.5, 0.75, 1.0])
    found = contour(partial(pitch_hz, sample_rate_hz=RATE), pulses(hertz, 1.0), RATE, times)
    assert found[1:-1] == pytest.approx([135.0, 150.0, 165.0], rel=0.01)
    assert found[0] == pytest.approx(121.0, rel=0.02) and found[-1] == pytest.approx(179.0, rel=0.02)
