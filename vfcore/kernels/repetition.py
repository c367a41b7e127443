"""Normalised autocorrelation of a wave, and the lag at which it is greatest: the period.

    r(τ) = Σ x(t) x(t+τ) / √(Σ x(t)² Σ x(t+τ)²)

over the overlap of the two copies, x with its mean removed. The products come from FFTs (vfcore/measures/pitch.py) or
from ``likeness``: for windows of 60 ms the direct sum takes no longer and uses little memory.
"""

import math

from vfcore.kernels.jit import formula, inlined, jit

#: An overlap with less than this fraction of the energy of the wave counts as silent.
SILENT = 1e-12


@formula
def vertex(before, at, after):
    """Offset (samples, within ±1/2) and height of the extremum of the parabola through three neighbours."""
    curvature = before - 2.0 * at + after
    offset = min(max(0.5 * (before - after) / curvature, -0.5), 0.5) if curvature != 0.0 else 0.0
    return offset, at - 0.25 * (before - after) * offset


@inlined
def normalise(x, values):
    """Turn the products ``values`` (lags,) at lags 0, 1, … of ``x`` (n,), of mean 0, into r."""
    n, energy = x.size, 0.0
    for i in range(n):
        energy += x[i] * x[i]
    head = tail = energy
    for lag in range(values.size):
        if lag > 0:
            head -= x[n - lag] * x[n - lag]
            tail -= x[lag - 1] * x[lag - 1]
        scale = math.sqrt(max(head, 0.0) * max(tail, 0.0))
        values[lag] = values[lag] / scale if scale > SILENT * energy else 0.0


@jit
def likeness(wave, x, values):
    """Fill ``values`` (lags,) with r at lags 0, 1, …; ``x`` (n,) with ``wave`` (n,) about its mean, of any unit."""
    n, mean = wave.size, 0.0
    for i in range(n):
        mean += wave[i]
    mean /= n
    for i in range(n):
        x[i] = wave[i] - mean
    for lag in range(values.size):
        product = 0.0
        for i in range(n - lag):
            product += x[i] * x[i + lag]
        values[lag] = product
    normalise(x, values)


@inlined
def maxima(values, lag_min, lag_max, rise, lags, heights):
    """Find the maxima of r from ``lag_min`` to ``lag_max`` that exceed the lowest r before them by ``rise``.

    Fills ``lags``, in fractional samples, and ``heights``, at most 1, shortest lag first; both need room for half as
    many as there are lags. Returns their number. The last of ``values`` (lags,) is never a maximum.
    """
    lowest, found = values[0], 0
    for lag in range(min(lag_max, values.size - 2) + 1):
        at = values[lag]
        lowest = min(lowest, at)
        if lag < lag_min:
            continue
        before, after = values[lag - 1], values[lag + 1]
        if at > before and at >= after and at > 0.0 and at > lowest + rise:
            offset, height = vertex(before, at, after)
            lags[found], heights[found] = lag + offset, min(height, 1.0)
            found += 1
    return found


@jit
def first_period(values, lag_min, rise, least, nearly, lags, heights):
    """The first of the ``maxima`` that reaches ``nearly`` times the highest; NaN if the highest is below ``least``.

    ``lags`` and ``heights`` are scratch, with room for half as many numbers as ``values`` (lags,).
    """
    found, highest = maxima(values, lag_min, values.size, rise, lags, heights), 0.0
    for k in range(found):
        highest = max(highest, heights[k])
    if highest < least:
        return math.nan
    for k in range(found):
        if heights[k] >= nearly * highest:
            return lags[k]
    return math.nan
