"""Quotients of the minimum glottal area waveform: how long it is closed, how it opens and closes.

A cycle of length T is closed while its area is below 0.1 % of its own peak. The instants of crossing are interpolated
between samples. Where the model's area is cut off at exactly 0, the sample on the closed side says nothing about when
it got there, so the crossing is extrapolated from the two samples on the open side and kept within its interval.
"""

from dataclasses import dataclass

import numpy as np

from vfcore.measures.cycles import CLOSED_FRACTION, Cycles, lowest_near, refined_extremum
from vfcore.measures.measure import Missing


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


def open_phases(area_m2: np.ndarray, cycles: Cycles) -> OpenPhases:
    """Open phases of the minimum glottal area ``area_m2`` (full wave, m²) in ``cycles``."""
    area = cycles.span(area_m2)
    level = (CLOSED_FRACTION * np.maximum.reduceat(area, cycles.offsets))[cycles.index]
    is_open = area > level
    steps = np.diff(is_open.astype(np.int8))
    rises, falls = np.flatnonzero(steps == 1), np.flatnonzero(steps == -1)
    ups = rises + 1 - _open_side(area, rises + 1, 1, level)
    downs = falls + _open_side(area, falls, -1, level)
    cycle_of_up, cycle_of_down = cycles.index[rises], cycles.index[falls]

    n = cycles.count
    first, last = cycles.offsets, cycles.offsets + cycles.lengths
    open_time = np.bincount(cycle_of_down, downs, n) - np.bincount(cycle_of_up, ups, n)
    open_time += np.where(np.append(is_open, is_open[-1])[last], last, 0.0) - np.where(is_open[first], first, 0.0)

    minima = refined_extremum(area_m2, lowest_near(area_m2, cycles.bounds, cycles.lengths.min() / 16))
    opens, closes = minima[:-1] - cycles.bounds[0], minima[1:] - cycles.bounds[0]
    opens[cycle_of_up[::-1]] = ups[::-1]
    closes[cycle_of_down] = downs
    peaks = refined_extremum(area_m2, cycles.where_largest(area_m2)) - cycles.bounds[0]
    return OpenPhases(np.clip(open_time / cycles.lengths, 0.0, 1.0), opens, peaks, closes)


def _open_side(area: np.ndarray, at: np.ndarray, outward: int, level: np.ndarray) -> np.ndarray:
    """How far (0 to 1 sample) the crossing lies before the open sample ``at``; ``outward`` points into the open phase.

    Two candidates: interpolation with the closed neighbour, or, if that one is cut off at 0, extrapolation.
    """
    value, threshold = area[at], level[at]
    closed = area[at - outward]
    beyond = area[np.clip(at + outward, 0, len(area) - 1)]
    slope = np.where((closed > 0.0) | (beyond <= value), value - closed, beyond - value)
    return np.clip((value - threshold) / slope, 0.0, 1.0)


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
