"""Quotients of the minimum glottal area waveform: how long it is closed, how it opens and closes.

A cycle of length T is closed while its area is below 0.1 % of its own peak. The instants of crossing are interpolated
between samples. Where the area is flat on the closed side, as a rule at 0, the sample there does not show when the
glottis closed or opened: the crossing is then extrapolated from the three samples on the open side, along the parabola
through them, and kept within its interval.
"""

from dataclasses import dataclass

import numpy as np

from vfcore.kernels import cycles as kernel
from vfcore.measures.cycles import CLOSED_FRACTION, Cycles, plain
from vfcore.measures.measure import Missing

# The area counts as flat where its next step is below this fraction of the step across the threshold.
FLANK = 0.01


@dataclass(frozen=True, slots=True)
class OpenPhases:
    """Per cycle, all of shape (N,), times in samples of the full wave.

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
    phases = np.empty((4, cycles.count))
    kernel.open_phases(plain(area_m2), cycles.bounds, largest_at, CLOSED_FRACTION, FLANK, phases)
    return OpenPhases(
        phases[kernel.OPEN_FRACTION], phases[kernel.OPENS], phases[kernel.PEAKS], phases[kernel.CLOSES]
    )  # fmt: skip


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


def peak_area_mm2(area_m2: np.ndarray, largest_at: np.ndarray) -> float:
    """Mean over cycles of the largest area, mm², found at the samples ``largest_at``."""
    return float(area_m2[largest_at].mean(dtype=np.float64) * 1e6)


def gap_area_mm2(area_m2: np.ndarray, cycles: Cycles) -> float:
    """Mean over cycles of the smallest area, mm²."""
    return float(cycles.smallest(area_m2).mean() * 1e6)
