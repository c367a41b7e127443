"""Shape of the glottis from displacements and medial planes, ``(…, nx, ny)``, and the phases of its cycle."""

import numpy as np

from vfcore.fold.closure import CLOSED_GAP_M
from vfcore.measures.cycles import CLOSED_FRACTION

#: Full gap up to which a slice is closed; the limit of the closure patterns of vfcore.
CLOSED_M = CLOSED_GAP_M


def full_gap(w_m: np.ndarray, medial_m: np.ndarray) -> np.ndarray:
    """Gap between the two folds, m: 2 max(G − w, 0)."""
    return 2.0 * np.maximum(medial_m - w_m, 0.0)


def slice_gap(w_m: np.ndarray, medial_m: np.ndarray) -> np.ndarray:
    """Smallest gap of each slice, (…, nx), m."""
    return full_gap(w_m, medial_m).min(axis=-1)


def at_place(values: np.ndarray, x_m: np.ndarray, x_over_l: float) -> np.ndarray:
    """``values`` (n, nx) at one x/L of each of n grids ``x_m`` (n, nx), between nodes linearly; (n,)."""
    return np.array([np.interp(x_over_l * x[-1], x, row) for x, row in zip(x_m, values, strict=True)])


def weights(nodes_m: np.ndarray) -> np.ndarray:
    """Length per node of an even grid, half at the ends, m."""
    width = np.full(len(nodes_m), nodes_m[1] - nodes_m[0])
    width[[0, -1]] *= 0.5
    return width


def posterior_share(gap_m: np.ndarray, x_m: np.ndarray) -> float:
    """Share of the open area of one shape, gap (nx,), that is behind mid-fold (a node at mid-fold counts half).

    NaN if nothing is open.
    """
    area = gap_m * weights(x_m)
    from_middle = x_m / x_m[-1] - 0.5
    behind = np.heaviside(np.where(np.abs(from_middle) < 1e-9, 0.0, from_middle), 0.5)
    return float((area * behind).sum() / area.sum()) if area.sum() > 0.0 else float("nan")


def opening_and_closing(area_m2: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Masks (p,) of the open phases in which the area rises, and of those in which it falls, over one cycle."""
    is_open = area_m2 > CLOSED_FRACTION * area_m2.max()
    slope = np.roll(area_m2, -1) - np.roll(area_m2, 1)
    return is_open & (slope > 0.0), is_open & (slope < 0.0)
