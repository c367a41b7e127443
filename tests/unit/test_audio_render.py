"""Resampling to 48 kHz: pass band, images and aliases measured with tones; time and level kept."""

import numpy as np
import pytest

from vfcore.errors import ParameterError
from vfcore.io.audio import AUDIO_RATE_HZ, render

DEFAULT_RATE = 35_000.000000000004  # the default step, four sections' travel
PAPER_RATE = 560_000.0
RATES = [5000.0, DEFAULT_RATE, 44_100.0, 36_217.123, 140_000.0, PAPER_RATE, 431_234.5]


def tone(frequency, rate, seconds=0.25):
    return np.sin(2 * np.pi * frequency * np.arange(round(seconds * rate)) / rate)


def fitted(audio, frequency):
    """Complex amplitude of a tone in the middle half, and the largest residual there."""
    middle = np.arange(audio.size // 4, 3 * audio.size // 4)
    window = np.blackman(middle.size)
    phase = 2 * np.pi * frequency * middle / AUDIO_RATE_HZ
    basis = np.stack([np.sin(phase), np.cos(phase)], axis=1)
    fit, *_ = np.linalg.lstsq(basis * window[:, None], audio[middle] * window, rcond=None)
    return complex(*fit), np.abs((audio[middle] - basis @ fit) * window).max()


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("fraction", [0.01, 0.2, 0.42])
def test_pass_band_keeps_level_and_time_and_makes_no_images(rate, fraction):
    frequency = fraction * min(rate, AUDIO_RATE_HZ)
    amplitude, leftover = fitted(render(tone(frequency, rate), rate), frequency)
    assert abs(amplitude - 1) < 0.00115  # 0.01 dB, and no shift in time: the sine stays a sine from t = 0
    assert 20 * np.log10(leftover) < -80


def test_the_clock_does_not_drift_over_a_long_run():
    rate = 33_333.3  # slightly off 100/3 kHz: a ratio of 36/25 would be 1e-6 too fast
    amplitude, _ = fitted(render(tone(10_000.0, rate, seconds=4.0), rate), 10_000.0)
    assert abs(amplitude - 1) < 0.00115


@pytest.mark.parametrize("rate", [140_000.0, PAPER_RATE, 431_234.5])
@pytest.mark.parametrize("frequency", [24_001.0, 30_000.0, 47_000.0, 69_000.0])
def test_what_48_khz_cannot_hold_is_rejected(rate, frequency):
    audio = render(tone(frequency, rate), rate)
    middle = audio[audio.size // 4 : 3 * audio.size // 4]
    assert 20 * np.log10(np.abs(middle).max()) < -80


@pytest.mark.parametrize("rate", RATES)
def test_one_second_stays_one_second_and_pascals_stay_pascals(rate):
    audio = render(np.full(round(rate), 3.0), rate)
    assert abs(audio.size - AUDIO_RATE_HZ) <= AUDIO_RATE_HZ / rate + 1
    assert np.abs(audio[5000:-5000] / 3.0 - 1).max() < 1e-3


def test_audio_at_48_khz_is_left_alone_but_copied():
    pressure = np.random.default_rng(0).standard_normal(1000)
    audio = render(pressure, 48_000)
    assert np.array_equal(audio, pressure)
    assert not np.shares_memory(audio, pressure)


def test_another_output_rate():
    audio = render(tone(1000.0, DEFAULT_RATE), DEFAULT_RATE, 16_000)
    assert audio.size == 4000
    expected = np.sin(2 * np.pi * 1000 * np.arange(4000) / 16_000)
    assert np.abs(audio - expected)[1000:3000].max() < 1e-3


@pytest.mark.parametrize(
    "pressure, rate, path",
    [
        (np.array([0.0, np.nan]), 35_000, "pressure_pa"),
        (np.zeros((2, 5)), 35_000, "pressure_pa"),
        (np.zeros(0), 35_000, "pressure_pa"),
        (np.zeros(5), 0, "sample_rate_hz"),
        (np.zeros(5), np.inf, "sample_rate_hz"),
    ],
)
def test_unusable_input_is_refused_by_name(pressure, rate, path):
    with pytest.raises(ParameterError) as caught:
        render(pressure, rate)
    assert caught.value.path == path
