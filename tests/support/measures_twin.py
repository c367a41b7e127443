"""Twins of the compiled loops of the measures, in numpy: vectorised over samples or cycles."""

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.signal import find_peaks


def vertex(before, at, after):
    """Offset and height of the extremum of the parabola through three neighbours; arrays."""
    curvature = before - 2.0 * at + after
    safe = np.where(curvature == 0.0, 1.0, curvature)
    offset = np.where(curvature == 0.0, 0.0, np.clip(0.5 * (before - after) / safe, -0.5, 0.5))
    return offset, at - 0.25 * (before - after) * offset


def repetition(wave):
    """Normalised autocorrelation at every lag up to half the length, each sum over its own overlap."""
    x = wave - wave.mean()
    n, values = len(x), np.zeros(len(x) // 2 + 2)
    for lag in range(len(values)):
        head, tail = x[: n - lag], x[lag:]
        scale = np.sqrt((head**2).sum() * (tail**2).sum())
        if scale > 1e-12 * (x**2).sum():
            values[lag] = (head * tail).sum() / scale
    return values


def maxima(values, lag_min, lag_max, rise):
    """Lags and heights of the maxima that exceed the lowest value before them by ``rise``."""
    lag_max = min(lag_max, len(values) - 2)
    lowest = np.minimum.accumulate(values[: lag_max + 1])[lag_min:]
    before, at, after = (values[lag_min + k : lag_max + 1 + k] for k in (-1, 0, 1))
    found = np.flatnonzero((at > before) & (at >= after) & (at > 0.0) & (at > lowest + rise))
    offset, height = vertex(before[found], at[found], after[found])
    return found + lag_min + offset, np.minimum(height, 1.0)


def where_largest(wave, bounds):
    return np.array([a + int(np.argmax(wave[a:b])) for a, b in zip(bounds[:-1], bounds[1:], strict=True)])


def time_above(wave, bounds, fraction):
    cycles = [wave[a:b] for a, b in zip(bounds[:-1], bounds[1:], strict=True)]
    return np.array([np.mean(cycle > fraction * cycle.max()) for cycle in cycles])


def refined(wave, at):
    at = np.clip(at, 1, len(wave) - 2)
    return at + vertex(*(wave[at + k] for k in (-1, 0, 1)))[0]


def spaced_minima(wave, distance):
    return find_peaks(-wave, distance=distance)[0]


def lowest_near(wave, places, reach):
    around = np.clip(places[:, None] + np.arange(-reach, reach + 1), 0, len(wave) - 1)
    return around[np.arange(len(places)), wave[around].argmin(axis=1)]


def open_phases(wave, bounds, largest_at, closed_fraction, flank):
    """(4, N): open fraction of the cycle; opening, peak and closing in samples of ``wave``."""
    area, lengths, first = wave[bounds[0] : bounds[-1]], np.diff(bounds), bounds[:-1] - bounds[0]
    level = np.repeat(closed_fraction * np.maximum.reduceat(area, first), lengths)
    is_open = area > level
    crossings = np.flatnonzero(is_open[1:] != is_open[:-1])
    opening = is_open[crossings + 1]
    outward, at = np.where(opening, 1, -1), crossings + opening
    instants = at - outward * _open_side(area, at, outward, level, flank)
    cycle = np.searchsorted(first, crossings, side="right") - 1
    ups, downs, of_up, of_down = instants[opening], instants[~opening], cycle[opening], cycle[~opening]
    last, n = first + lengths, len(lengths)
    begin = np.bincount(of_up, ups, n) + np.where(is_open[first], first, 0.0)
    end = np.bincount(of_down, downs, n) + np.where(is_open[np.minimum(last, len(is_open) - 1)], last, 0.0)
    minima = refined(wave, lowest_near(wave, bounds, lengths.min() // 16)) - bounds[0]
    opens, closes = minima[:-1].copy(), minima[1:].copy()
    opens[of_up[::-1]] = ups[::-1]
    closes[of_down] = downs
    share = np.clip((end - begin) / lengths, 0.0, 1.0)
    return np.array([share, opens + bounds[0], refined(wave, largest_at), closes + bounds[0]])


def _open_side(area, at, outward, level, flank):
    around = np.pad(area, 2, mode="edge")
    beyond, closed, value, inside, deeper = (around[at + (2 + k * outward)] for k in (-2, -1, 0, 1, 2))
    height = value - level[at]
    curve = 0.5 * (value - 2.0 * inside + deeper)
    slope = value - inside + curve
    interpolate = (closed - beyond > flank * (value - closed)) | (slope >= 0.0)
    root = np.sqrt(np.maximum(slope**2 - 4.0 * curve * height, 0.0))
    per_sample = np.where(interpolate, value - closed, 0.5 * (root - slope))
    share = np.divide(height, per_sample, out=np.zeros_like(height), where=per_sample > 0.0)
    return np.clip(share, 0.0, 1.0)


def gaussian_slope(wave, sigma, reach):
    """Derivative per sample with a Gaussian low-pass filter; the ends of the wave are continued."""
    return gaussian_filter1d(wave, sigma, order=1, radius=reach, mode="nearest")


def first_two(wave, window, turn):
    """Magnitudes of the lines at ``turn`` and 2·``turn``, rad per sample, by definition."""
    x = (wave - wave.mean()) * window
    return tuple(abs((x * np.exp(1j * h * turn * np.arange(len(x)))).sum()) for h in (1, 2))


def windowed_frames(wave, window, hop):
    frames = np.lib.stride_tricks.sliding_window_view(wave, len(window))[::hop]
    return (frames - frames.mean(axis=1, keepdims=True)) * window


def relative_power(spectrum, least, lines):
    power = np.abs(spectrum[:, :lines]) ** 2
    return np.maximum(power / power.max(axis=1, keepdims=True), least)


def mean_prominence(cepstrum, fitted_from, first, last):
    """Mean over frames of the height of the peak above the regression line."""
    places, heights = np.arange(cepstrum.shape[1]), []
    for frame in cepstrum:
        line = np.polyval(np.polyfit(places[fitted_from:], frame[fitted_from:], 1), places)
        peak = first + int(frame[first:last].argmax())
        heights.append(frame[peak] - line[peak])
    return np.mean(heights)
