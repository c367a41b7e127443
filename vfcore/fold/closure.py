"""The closure pattern of a glottis, with its clinical name.

From the smallest gap of each slice, gap(x) from the anterior commissure (x = 0) to the vocal
process (x = L). A slice is closed when its gap is below ``CLOSED_GAP_M``. Regions count when
they are longer than ``SHORTEST_REGION`` of the length; the first node (the commissure, always
closed) is excluded.

complete            closed along the whole length
posterior_opening   open posteriorly only
anterior_opening    open anteriorly only
spindle             open in the middle, closed at both ends
hourglass           closed in the middle, open at both ends
open                no contact

Names: Södersten, Hertegård & Hammarberg (1995); the thresholds are this project's.
"""

from dataclasses import dataclass
from itertools import groupby

import numpy as np

CLOSED_GAP_M = 5e-5  # full gap; 0.05 mm is below what a laryngoscope shows
SHORTEST_REGION = 0.15  # of the length; near the commissure the folds always touch

PATTERNS = ("complete", "posterior_opening", "anterior_opening", "hourglass", "spindle", "open")


@dataclass(frozen=True, slots=True)
class ClosureShape:
    """``pattern`` (one of PATTERNS), ``closed_fraction`` of the length, ``open_area_m2`` of the glottis."""

    pattern: str
    closed_fraction: float
    open_area_m2: float


def describe_closure(gap_m: np.ndarray, x_m: np.ndarray) -> ClosureShape:
    """Name the pattern of ``gap_m`` (nx,), full gap at ``x_m`` (nx,), ends included."""
    closed = gap_m[1:] <= CLOSED_GAP_M
    area = float(np.trapezoid(gap_m, x_m))
    fraction = float(closed.mean())
    runs = _long_runs(closed)
    states = [state for state, _ in runs]
    if not any(states):
        pattern = "open"
    elif all(states):
        pattern = "complete"
    elif states == [True, False]:
        pattern = "posterior_opening"
    elif states == [False, True]:
        pattern = "anterior_opening"
    elif not states[0] and not states[-1]:
        pattern = "hourglass"
    elif states[0] and states[-1]:
        pattern = "spindle"
    else:  # several alternations: named by the open end
        pattern = "posterior_opening" if not states[-1] else "anterior_opening"
    return ClosureShape(pattern, fraction, area)


def _long_runs(closed: np.ndarray) -> list[tuple[bool, int]]:
    """Runs of equal state (closed or open) and their lengths; runs up to SHORTEST_REGION are dropped."""
    pieces = [(state, len(list(run))) for state, run in groupby(closed.tolist())]
    shortest = SHORTEST_REGION * len(closed)
    kept = [piece for piece in pieces if piece[1] > shortest] or [(bool(closed.mean() > 0.5), len(closed))]
    merged = [kept[0]]
    for state, length in kept[1:]:
        if state == merged[-1][0]:
            merged[-1] = (state, merged[-1][1] + length)
        else:
            merged.append((state, length))
    return merged
