"""The sound file, read back by another library: level, fades, silence, and no silent clipping."""

import io

import numpy as np
import pytest
from scipy.io import wavfile

from vfcore.errors import ParameterError
from vfcore.io.audio import FULL_SCALE_PA, to_wav_bytes

TIME = np.arange(48_000) / 48_000
LOUD = 150.0 * np.sin(2 * np.pi * 150 * TIME) + 40 * np.sin(2 * np.pi * 700 * TIME)


def read(content):
    rate, samples = wavfile.read(io.BytesIO(content))
    return rate, samples


def test_file_is_48_khz_mono_pcm16_of_the_same_length():
    rate, samples = read(to_wav_bytes(LOUD)[0])
    assert (rate, samples.dtype, samples.shape) == (48_000, np.int16, (48_000,))


def test_peak_is_3_db_below_full_scale_and_the_gain_says_how():
    content, gain = to_wav_bytes(LOUD)
    samples = read(content)[1] / 32767
    assert 20 * np.log10(np.abs(samples).max()) == pytest.approx(-3, abs=0.001)
    inside = slice(480, -480)
    assert np.abs(samples[inside] - gain * LOUD[inside]).max() < 1e-4


@pytest.mark.parametrize("level", [1e-6, 1.0, 1e6])
def test_any_level_normalises_to_the_same_file(level):
    assert to_wav_bytes(LOUD * level)[1] == pytest.approx(to_wav_bytes(LOUD)[1] / level, rel=1e-9)
    assert np.abs(read(to_wav_bytes(LOUD * level)[0])[1] - read(to_wav_bytes(LOUD)[0])[1]).max() <= 1


def test_both_ends_fade_over_10_ms_as_raised_cosines():
    square = np.where(np.arange(48_000) % 2, 1.0, -1.0)  # constant size, mean 0: the file's size is the envelope
    samples = np.abs(read(to_wav_bytes(square)[0])[1]) / (32767 * 10 ** (-3 / 20))
    expected = np.sin(np.pi / 2 * TIME[:480] / 0.010) ** 2
    assert np.abs(samples[:480] - expected).max() < 0.002
    assert np.abs(samples[-480:] - expected[::-1]).max() < 0.004  # the last sample is one step before the end
    assert np.abs(samples[480:-480] - 1).max() < 1e-3
    assert samples[0] < 1e-3 and samples[-1] < 1e-3


def test_a_constant_offset_is_removed_and_does_not_cost_level():
    content, gain = to_wav_bytes(LOUD + 500.0)
    samples = read(content)[1] / 32767
    assert abs(samples.mean()) < 1e-5
    assert gain == pytest.approx(to_wav_bytes(LOUD)[1], rel=1e-3)


def test_a_run_without_phonation_is_exact_silence():
    content, gain = to_wav_bytes(LOUD, phonating=False)
    samples = read(content)[1]
    assert samples.size == 48_000
    assert not samples.any()
    assert gain == 0.0


@pytest.mark.parametrize("pressure", [0.0, 12.5])
def test_no_sound_is_silence_not_amplified_rounding(pressure):
    content, gain = to_wav_bytes(np.full(4800, pressure))
    assert not read(content)[1].any()
    assert gain == 0.0


def test_without_normalisation_full_scale_is_170_db():
    content, gain = to_wav_bytes(LOUD, normalize=False)
    assert 20 * np.log10(1 / gain / 20e-6) == pytest.approx(170)
    samples = read(content)[1] / 32767
    assert np.abs(samples[480:-480] / gain - LOUD[480:-480]).max() < 0.12  # half a step of 16 bits is 0.1 Pa


def test_without_normalisation_a_sound_that_would_clip_is_refused():
    edge = FULL_SCALE_PA * np.sin(2 * np.pi * 1000 * TIME)
    assert np.abs(read(to_wav_bytes(0.999 * edge, normalize=False)[0])[1]).max() < 32767
    with pytest.raises(ParameterError, match="would clip"):
        to_wav_bytes(1.001 * edge, normalize=False)


@pytest.mark.parametrize("count", [1, 2, 3, 100, 959, 961])
def test_a_very_short_sound_still_makes_a_file(count):
    audio = np.random.default_rng(count).standard_normal(count)
    samples = read(to_wav_bytes(audio)[0])[1]
    assert samples.size == count
    assert np.abs(samples).max() <= 32767 * 10 ** (-3 / 20) + 1


@pytest.mark.parametrize("audio", [np.array([0.0, np.nan]), np.array([np.inf, 0.0]), np.zeros((2, 2)), np.zeros(0)])
def test_audio_that_is_no_waveform_is_refused(audio):
    with pytest.raises(ParameterError, match="audio_pa"):
        to_wav_bytes(audio)
