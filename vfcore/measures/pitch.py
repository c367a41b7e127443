"""Periods by autocorrelation: how alike the wave is to itself one lag later.

r(τ) = Σ x(t) x(t+τ) / √(Σ x(t)² Σ x(t+τ)²), both sums over the part where the two copies overlap, x with its
mean removed. Dividing by the energies of the two overlapping parts makes r(T) = 1 for any exactly repeating
wave, whatever the number of cycles in the window and however steadily its amplitude changes
(Boersma 1993 divides out the window for the same reason).

r gives the root-mean-square difference between the wave and its copy, as a fraction of its own rms:
e = √(2 (1 − r)).
"""

from dataclasses import dataclass

import numpy as np
from scipy import fft

from vfcore.kernels.repetition import maxima, normalise, vertex

# The repeating pattern is sought between these rates. Adult voices lie within 60–1000 Hz; the lower end leaves
# room for patterns of several cycles.
LOWEST_RATE_HZ = 20.0
HIGHEST_RATE_HZ = 1000.0
# Long lags divide the error of a period by their number of cycles, as long as the wave still matches itself.
REFINE_MATCH = 0.9
# Noise ripples r by about 1/√n, less than 0.01; any cycle makes it fall and rise by more than this.
PEAK_RISE = 0.1


@dataclass(frozen=True, slots=True)
class Peak:
    """A local maximum of the autocorrelation: lag in samples (sub-sample) and height."""

    lag: float
    height: float


@dataclass(frozen=True, eq=False)
class Autocorrelation:
    """Normalised autocorrelation r of one wave, shape (n,), for lags up to half its length.

    ``values``: shape (n // 2 + 2,), dimensionless. A constant wave has r = 0. ``spectrum``: that of the wave about its
    mean, filled up with zeros to ``size`` samples.
    """

    values: np.ndarray
    spectrum: np.ndarray
    size: int
    n: int

    def peaks(self, lag_min: int, lag_max: int) -> list[Peak]:
        """Positive local maxima of r between the lags ``lag_min`` and ``lag_max`` (samples), shortest lag first.

        Each is higher by ``PEAK_RISE`` than the lowest r at shorter lags, so a ripple on the fall from lag 0 is none.
        """
        lags, heights = np.empty((2, len(self.values) // 2 + 1))
        found = maxima(self.values, lag_min, lag_max, PEAK_RISE, lags, heights)
        return [Peak(*one) for one in zip(lags[:found].tolist(), heights[:found].tolist(), strict=True)]

    def near(self, lag: float, reach: float) -> Peak:
        """The highest value within ``reach`` samples of ``lag``, refined."""
        low = max(int(np.ceil(lag - reach)), 1)
        high = min(int(np.floor(lag + reach)), len(self.values) - 2)
        lag = low + int(np.argmax(self.values[low : high + 1]))
        offset, height = vertex(*self.values[lag - 1 : lag + 2].tolist())
        return Peak(lag + offset, min(height, 1.0))

    def long_term_period(self, period: float) -> float:
        """``period`` (samples), refined by matching the wave with itself ever more cycles later."""
        count = 1
        while 2 * count * period < len(self.values) - 2:
            count *= 2
            peak = self.near(count * period, period / 8)
            if peak.height < REFINE_MATCH:
                break
            period = peak.lag / count
        return period

    def slow_part(self, rate: float) -> np.ndarray:
        """The wave at and below ``rate`` (cycles per sample), without its harmonics and without delay; shape (n,).

        Gain 1 up to the rate, a raised-cosine fall to 0 at 1.9 times the rate.
        """
        fall = np.clip((np.arange(len(self.spectrum)) / (self.size * rate) - 1.0) / 0.9, 0.0, 1.0)
        return fft.irfft(self.spectrum * (0.5 + 0.5 * np.cos(np.pi * fall)), self.size)[: self.n]


def autocorrelation(wave: np.ndarray) -> Autocorrelation:
    """The autocorrelation of ``wave``, shape (n,), any unit."""
    return autocorrelations(np.asarray(wave, dtype=np.float64)[None])[0]


def autocorrelations(waves: np.ndarray) -> list[Autocorrelation]:
    """The autocorrelations of ``waves``, shape (count, n), transformed in one call in the precision they have."""
    x = waves - waves.mean(axis=1, keepdims=True)
    n = x.shape[1]
    keep = n // 2 + 2
    size = fft.next_fast_len(n + keep, real=True)
    spectra = fft.rfft(x, size)
    power = spectra.real**2 + spectra.imag**2
    products = fft.irfft(power, size, overwrite_x=True)[:, :keep]
    found = []
    for wave, spectrum, of_wave in zip(x, spectra, products, strict=True):
        values = of_wave.astype(np.float64, copy=False)
        normalise(wave.astype(np.float64, copy=False), values)
        found.append(Autocorrelation(values, spectrum, size, n))
    return found
