"""Trends over maps ``(n, m)``, NaN in cells that are not judged. Axis 0 is CT, axis 1 is TA."""

import warnings

import numpy as np
from scipy.stats import spearmanr

MIN_POINTS = 4  # of a line, for a rank correlation or a valley


def rising_share(values: np.ndarray, axis: int) -> float:
    """Share of the pairs of neighbouring finite cells along ``axis`` whose value rises; NaN without pairs."""
    steps = np.diff(values, axis=axis)
    steps = steps[np.isfinite(steps)]
    return float((steps > 0.0).mean()) if len(steps) else float("nan")


def lines(values: np.ndarray, axis: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """(positions, values) of the finite cells of each line along ``axis`` that has at least MIN_POINTS of them."""
    found = []
    for line in np.moveaxis(values, axis, -1):
        at = np.flatnonzero(np.isfinite(line))
        if len(at) >= MIN_POINTS:
            found.append((at, line[at]))
    return found


def median_spearman(values: np.ndarray, axis: int) -> float:
    """Median over lines of the rank correlation between position and value; a constant line counts as 0."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a constant line has no rank correlation
        found = [float(spearmanr(at, line).statistic) for at, line in lines(values, axis)]
    return float(np.median(np.nan_to_num(found))) if found else float("nan")


def median_range(values: np.ndarray, axis: int, relative: bool = False) -> float:
    """Median over lines of largest minus smallest value, over the line's mean if ``relative``."""
    found = [np.ptp(line) / (line.mean() if relative else 1.0) for _, line in lines(values, axis)]
    return float(np.median(found)) if found else float("nan")


def slope(position: np.ndarray, values: np.ndarray) -> float:
    """Least-squares slope."""
    return float(np.polyfit(position, values, 1)[0])


def smoothed(values: np.ndarray) -> np.ndarray:
    """Mean of the finite cells of each 3 × 3 neighbourhood; NaN where the cell itself is."""
    padded = np.pad(values, 1, constant_values=np.nan)
    around = np.lib.stride_tricks.sliding_window_view(padded, (3, 3)).reshape(*values.shape, 9)
    finite = np.isfinite(around)
    count = np.maximum(finite.sum(axis=-1), 1)
    return np.where(np.isfinite(values), np.where(finite, around, 0.0).sum(axis=-1) / count, np.nan)


def valley_depth(line: np.ndarray) -> float:
    """Depth of the deepest valley of ``line`` below the lower of the maxima on its two sides; 0 without one."""
    left = np.maximum.accumulate(line)
    right = np.maximum.accumulate(line[::-1])[::-1]
    return float((np.minimum(left, right) - line).max())
