"""The first lag at which a wave is nearly as much like itself as at any: its period, sought in one call.

r(τ) = Σ x(t) x(t+τ) / √(Σ x(t)² Σ x(t+τ)²) over the overlap, x with its mean removed, and its maxima: the law of
vfcore/measures/pitch.py, which is the twin (there by transforms, for waves of any length). Windows of 60 ms are so
short that the sum as it stands takes no longer, and touches little memory.
"""

import math

from vfcore.kernels.jit import jit

#: Below this part of a wave's energy an overlap is silence.
SILENT = 1e-12


@jit
def likeness(wave, x, values):
    """Fill ``values`` (lags,) with r at lags 0, 1, …; ``x`` (n,) with ``wave`` (n,) about its mean, of any unit."""
    n, mean = wave.size, 0.0
    for i in range(n):
        mean += wave[i]
    mean /= n
    energy = 0.0
    for i in range(n):
        x[i] = wave[i] - mean
        energy += x[i] * x[i]
    head = tail = energy
    for lag in range(values.size):
        if lag > 0:
            head -= x[n - lag] * x[n - lag]
            tail -= x[lag - 1] * x[lag - 1]
        product = 0.0
        for i in range(n - lag):
            product += x[i] * x[i + lag]
        scale = math.sqrt(max(head, 0.0) * max(tail, 0.0))
        values[lag] = product / scale if scale > SILENT * energy else 0.0


@jit
def first_period(values, lag_min, rise, least, nearly):
    """Lag, in samples and parts of one, of the first maximum of r that is ``nearly`` as high as the highest.

    Maxima count from ``lag_min`` on where they stand ``rise`` above the lowest r before them. NaN where the highest
    is below ``least``. The last two of ``values`` are no place for a maximum.
    """
    highest = 0.0
    for search in range(2):
        lowest = values[0]
        for lag in range(values.size - 1):
            at = values[lag]
            lowest = min(lowest, at)
            if lag < lag_min:
                continue
            before, after = values[lag - 1], values[lag + 1]
            if not (at > before and at >= after and at > 0.0 and at > lowest + rise):
                continue
            curvature = before - 2.0 * at + after
            offset = min(max(0.5 * (before - after) / curvature, -0.5), 0.5) if curvature != 0.0 else 0.0
            height = min(at - 0.25 * (before - after) * offset, 1.0)
            if search == 0:
                highest = max(highest, height)
            elif height >= nearly * highest:
                return lag + offset
        if highest < least:
            return math.nan
    return math.nan
