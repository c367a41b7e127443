"""Low-pass filtered derivative of a wave: convolution with the derivative of a Gaussian.

    ẋ_i = Σ_{k=1}^{r} c_k (x_{i+k} − x_{i−k}),   c_k = (k/σ²) e^{−k²/2σ²} / Σ_{|j|≤r} e^{−j²/2σ²}

per sample, σ and r in samples; beyond its ends the wave is continued with its first and last sample. Twin: scipy's
gaussian_filter1d of order 1 (tests/support/measures_twin.py).
"""

import math

from vfcore.kernels.jit import jit


@jit
def gaussian_slope(wave, begin, sigma, reach, slope):
    """Fill ``slope`` (n,) with the derivative of ``wave`` at its samples from ``begin`` on, per sample."""
    weight = 1.0
    for k in range(1, reach + 1):
        weight += 2.0 * math.exp(-0.5 * k * k / (sigma * sigma))
    low, high = max(reach - begin, 0), min(wave.size - reach - begin, slope.size)
    for i in range(slope.size):
        slope[i] = 0.0
    for k in range(1, reach + 1):
        c = k / (sigma * sigma) * math.exp(-0.5 * k * k / (sigma * sigma)) / weight
        if high > low:
            inner, ahead, behind = slope[low:high], wave[begin + low + k :], wave[begin + low - k :]
            for i in range(high - low):
                inner[i] += c * (ahead[i] - behind[i])
        for i in range(min(low, slope.size)):
            slope[i] += c * (wave[min(begin + i + k, wave.size - 1)] - wave[max(begin + i - k, 0)])
        for i in range(max(high, low), slope.size):
            slope[i] += c * (wave[min(begin + i + k, wave.size - 1)] - wave[max(begin + i - k, 0)])
