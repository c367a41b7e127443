"""Measures of the spectrum: first two harmonics, and the cepstral peak.

Cepstral peak prominence after Hillenbrand, Cleveland & Erickson (1994): the power spectrum in dB of each 51.2 ms
Hamming-windowed frame, up to 10 kHz (1024 points at 20 kHz in the original), is itself transformed; the magnitude of
that cepstrum, in dB, has a peak at the quefrency 1/f_o. CPP is its height above the straight line fitted to the
cepstrum from 1 ms to the end, averaged over frames.

Lengths with large prime factors take eight times as long to transform. So a frame is filled up with zeros to a length
without them that has a spectral line at 10 kHz, as in the original: at 28 kHz from 1434 to 1470 samples, line 525.
"""

from collections.abc import Callable
from functools import lru_cache
from math import isqrt, log10

import numpy as np
from scipy import fft

from vfcore.kernels.cepstrum import mean_prominence, relative_power, windowed_frames
from vfcore.kernels.harmonics import first_two
from vfcore.measures.cycles import plain
from vfcore.measures.measure import Missing

CPP_FRAME_S = 0.0512
CPP_HOP_S = 0.0256
CPP_BAND_HZ = 10_000.0
CPP_LINE_FROM_S = 1e-3
CPP_LOWEST_HZ = 60.0
CPP_HIGHEST_HZ = 500.0
# Spectral lines weaker than this, relative to the frame's strongest, are rounding errors of single precision.
CPP_FLOOR_DB = -140.0


def h1_h2_db(wave: np.ndarray, fo_hz: float, sample_rate_hz: float) -> float | Missing:
    """Level of the first harmonic above the second, dB, of ``wave``, shape (n,), as it is (no formant correction).

    Hann window; each harmonic is read at its exact frequency.
    """
    table = np.empty((4, isqrt(len(wave)) + 1))
    h1, h2 = first_two(plain(wave), _window(np.hanning, len(wave)), 2.0 * np.pi * fo_hz / sample_rate_hz, table)
    if h1 == 0.0 or h2 == 0.0:
        return Missing("One of the first two harmonics is absent.")
    return 20.0 * log10(h1 / h2)


def cepstral_peak_prominence_db(wave: np.ndarray, sample_rate_hz: float) -> float | Missing:
    """CPP of ``wave``, shape (n,), dB, computed in the precision of the wave."""
    length, hop = round(CPP_FRAME_S * sample_rate_hz), round(CPP_HOP_S * sample_rate_hz)
    if len(wave) < length:
        return Missing(f"The measured part is shorter than one frame of {CPP_FRAME_S * 1e3:g} ms.")
    filled, last_line = _transform_lengths(length, sample_rate_hz)
    frames = np.zeros((1 + (len(wave) - length) // hop, filled), wave.dtype)
    windowed_frames(plain(wave), _window(np.hamming, length), hop, frames)
    spectrum = fft.rfft(frames, axis=1, overwrite_x=True)
    lines = min(last_line + 1, spectrum.shape[1])
    power = np.empty((len(frames), lines), wave.dtype)
    if not relative_power(spectrum, 10.0 ** (CPP_FLOOR_DB / 10.0), power):
        return Missing("There is no sound in part of what is measured.")
    level = 10.0 * np.log10(power, out=power)
    cepstrum = np.abs(fft.irfft(level, 2 * (lines - 1), axis=1)[:, :lines])
    cepstrum = 20.0 * np.log10(cepstrum + np.finfo(wave.dtype).tiny, out=cepstrum)
    quefrency = np.arange(lines) * (filled / sample_rate_hz) / (2 * (lines - 1))
    fitted_from, first = np.searchsorted(quefrency, (CPP_LINE_FROM_S, 1.0 / CPP_HIGHEST_HZ))
    last = np.searchsorted(quefrency, 1.0 / CPP_LOWEST_HZ, side="right")
    return float(mean_prominence(cepstrum, fitted_from, first, last))


@lru_cache(maxsize=8)
def _transform_lengths(length: int, sample_rate_hz: float) -> tuple[int, int]:
    """To how many samples a frame of ``length`` is filled up, and which line of its spectrum is at CPP_BAND_HZ.

    Where up to a tenth more samples give no such line: ``length`` itself and the last line below.
    """
    for filled in range(length, length + length // 10):
        line = CPP_BAND_HZ * filled / sample_rate_hz
        fast = fft.next_fast_len(filled) == filled and fft.next_fast_len(2 * round(line)) == 2 * round(line)
        if fast and abs(line - round(line)) < 1e-9 * line:
            return filled, round(line)
    return length, int(CPP_BAND_HZ * length / sample_rate_hz)


@lru_cache(maxsize=8)
def _window(shape: Callable[[int], np.ndarray], n: int) -> np.ndarray:
    weights = shape(n)
    weights.setflags(write=False)
    return weights
