"""Quotients of the minimum glottal area waveform: how long it is closed, how it opens and closes.

A cycle of length T is closed while its area is below 0.1 % of its own peak. The instants of crossing are interpolated
between samples. Where the area lies flat on the closed side, at 0 as a rule, the sample there says nothing about when
it got there: the crossing is then extrapolated from the three samples on the open side, along the parabola through
them, and kept within its interval.
"""

from dataclasses import dataclass

import numpy as np

from vfcore.measures.cycles import CLOSED_FRACTION, Cycles, lowest_near, refined_extremum
from vfcore.measures.measure import Missing

# The area counts as flat where its next step is below this fraction of the step across the threshold.
FLANK = 0.01


@dataclass(frozen=True, slots=True)
class OpenPhases:
    """Per cycle, all of shape (N,), times in samples.

    ``open_fraction``: open time over cycle length. ``opens``, ``peaks``, ``closes``: start of the open phase, area
    peak, end of the open phase. A cycle that never closes is all open phase, from one area minimum to the next.
    """

    open_fraction: np.ndarray
    opens: np.ndarray
    peaks: np.ndarray
    closes: np.ndarray


def open_phases(area_m2: np.ndarray, cycles: Cycles, largest_at: np.ndarray) -> OpenPhases:
    """Open phases of the minimum glottal area ``area_m2`` (full wave, m²) in ``cycles``, whose largest areas are at the
    samples ``largest_at``.
    """
    area = cycles.span(area_m2)
    level = cycles.spread(CLOSED_FRACTION * np.maximum.reduceat(area, cycles.offsets))
    is_open = area > level
    crossings = np.flatnonzero(is_open[1:] != is_open[:-1])
    opening = is_open[crossings + 1]
    outward = np.where(opening, 1, -1)
    at = crossings + opening
    instants = at - outward * _open_side(area, at, outward, level)
    cycle = cycles.cycle_of(crossings)
    ups, downs = instants[opening], instants[~opening]
    cycle_of_up, cycle_of_down = cycle[opening], cycle[~opening]

    n = cycles.count
    first, last = cycles.offsets, cycles.offsets + cycles.lengths
    still_open = is_open[np.minimum(last, len(is_open) - 1)]
    begin = np.bincount(cycle_of_up, ups, n) + np.where(is_open[first], first, 0.0)
    end = np.bincount(cycle_of_down, downs, n) + np.where(still_open, last, 0.0)

    minima = refined_extremum(area_m2, lowest_near(area_m2, cycles.bounds, cycles.lengths.min() / 16))
    opens, closes = minima[:-1] - cycles.bounds[0], minima[1:] - cycles.bounds[0]
    opens[cycle_of_up[::-1]] = ups[::-1]
    closes[cycle_of_down] = downs
    peaks = refined_extremum(area_m2, largest_at) - cycles.bounds[0]
    return OpenPhases(np.clip((end - begin) / cycles.lengths, 0.0, 1.0), opens, peaks, closes)


def _open_side(area: np.ndarray, at: np.ndarray, outward: np.ndarray, level: np.ndarray) -> np.ndarray:
    """How far (0 to 1 sample) the crossings lie before the open samples ``at``; ``outward``, 1 or −1, points into the
    open phase.

    The closed neighbour is used if it lies on the flank, that is, if the area falls further beyond it.
    """
    around = np.pad(area, 2, mode="edge")
    beyond, closed, value, inside, deeper = (around[at + (2 + k * outward)] for k in (-2, -1, 0, 1, 2))
    height = value - level[at]
    # value + slope s + curve s² through the three open samples, s counted towards the closed side.
    curve = 0.5 * (value - 2.0 * inside + deeper)
    slope = value - inside + curve
    interpolate = (closed - beyond > FLANK * (value - closed)) | (slope >= 0.0)
    root = np.sqrt(np.maximum(slope**2 - 4.0 * curve * height, 0.0))
    per_sample = np.where(interpolate, value - closed, 0.5 * (root - slope))
    # A plateau right at the level has no slope: the crossing is the sample itself.
    share = np.divide(height, per_sample, out=np.zeros_like(height), where=per_sample > 0.0)
    return np.clip(share, 0.0, 1.0)


def mean_cycle_length(phases: OpenPhases) -> float:
    """Mean time from one opening to the next, samples."""
    return float(np.diff(phases.opens).mean())


def closed_quotient(phases: OpenPhases) -> float:
    """Mean fraction of the cycle with the glottis closed; 0 where it never closes."""
    return float(1.0 - phases.open_fraction.mean())


def open_quotient(phases: OpenPhases) -> float:
    """Mean fraction of the cycle with the glottis open: 1 − CQ."""
    return float(phases.open_fraction.mean())


def speed_quotient(phases: OpenPhases) -> float | Missing:
    """Mean over cycles of opening time over closing time (cycles cut off at their peak left out)."""
    opening, closing = phases.peaks - phases.opens, phases.closes - phases.peaks
    both = (opening > 0.0) & (closing > 0.0)
    if not both.any():
        return Missing("In no cycle does the area both rise to its peak and fall from it.")
    return float((opening[both] / closing[both]).mean())


def peak_area_mm2(area_m2: np.ndarray, cycles: Cycles) -> float:
    """Mean over cycles of the largest area, mm²."""
    return float(cycles.largest(area_m2).mean() * 1e6)


def gap_area_mm2(area_m2: np.ndarray, cycles: Cycles) -> float:
    """Mean over cycles of the smallest area, mm²."""
    return float(cycles.smallest(area_m2).mean() * 1e6)
