"""Periods by autocorrelation: how alike the wave is to itself one lag later.

r(τ) = Σ x(t) x(t+τ) / √(Σ x(t)² Σ x(t+τ)²), both sums over the part where the two copies overlap, x with its
mean removed. Dividing by the energies of the two overlapping parts makes r(T) = 1 for any exactly repeating
wave, whatever the number of cycles in the window and whether or not its amplitude changes steadily
(Boersma 1993 divides out the window for the same reason).

r gives the root-mean-square difference between the wave and its copy, as a fraction of its own rms:
e = √(2 (1 − r)).
"""

from dataclasses import dataclass

import numpy as np
from scipy import fft

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


class Autocorrelation:
    """Normalised autocorrelation r of one wave for lags up to half its length.

    ``wave``: shape (n,), any unit. ``values``: shape (n // 2 + 2,), dimensionless. A constant wave has r = 0.
    """

    def __init__(self, wave: np.ndarray):
        x = np.asarray(wave, dtype=np.float64)
        x = x - x.mean()
        n = len(x)
        keep = n // 2 + 2
        size = fft.next_fast_len(n + keep, real=True)
        self.spectrum = fft.rfft(x, size)
        power = self.spectrum.real**2 + self.spectrum.imag**2
        product = fft.irfft(power, size)[:keep]
        energy = np.concatenate(([0.0], np.cumsum(x * x)))
        head = energy[n : n - keep : -1]
        tail = energy[n] - energy[:keep]
        scale = np.sqrt(head * tail)
        self.size = size
        self.n = n
        self.values = np.divide(product, scale, out=np.zeros(keep), where=scale > 1e-12 * energy[n])

    def peaks(self, lag_min: int, lag_max: int) -> list[Peak]:
        """Positive local maxima of r between the lags ``lag_min`` and ``lag_max`` (samples), shortest lag first.

        Each stands ``PEAK_RISE`` above the lowest r at shorter lags: not a ripple on the way down from lag 0.
        """
        lag_max = min(lag_max, len(self.values) - 2)
        if lag_max < lag_min:
            return []
        lowest = np.minimum.accumulate(self.values[: lag_max + 1])[lag_min:]
        before, at, after = (self.values[lag_min + k : lag_max + 1 + k] for k in (-1, 0, 1))
        found = np.flatnonzero((at > before) & (at >= after) & (at > 0.0) & (at > lowest + PEAK_RISE))
        offset, height = parabola_vertex(before[found], at[found], after[found])
        lags, heights = found + lag_min + offset, np.minimum(height, 1.0)
        return [Peak(float(lag), float(height)) for lag, height in zip(lags, heights, strict=True)]

    def near(self, lag: float, reach: float) -> Peak:
        """The highest value within ``reach`` samples of ``lag``, refined."""
        low = max(int(np.ceil(lag - reach)), 1)
        high = min(int(np.floor(lag + reach)), len(self.values) - 2)
        lag = low + int(np.argmax(self.values[low : high + 1]))
        offset, height = parabola_vertex(*self.values[lag - 1 : lag + 2])
        return Peak(lag + float(offset), min(float(height), 1.0))

    def long_term_period(self, period: float) -> float:
        """``period`` (samples) made more accurate by matching the wave ever more cycles later."""
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


def parabola_vertex(before, at, after):
    """Offset (samples, within ±1/2) and height of the extremum of the parabola through three neighbours."""
    curvature = before - 2.0 * at + after
    safe = np.where(curvature == 0.0, 1.0, curvature)
    offset = np.where(curvature == 0.0, 0.0, np.clip(0.5 * (before - after) / safe, -0.5, 0.5))
    return offset, at - 0.25 * (before - after) * offset
