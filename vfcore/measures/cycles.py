"""Where cycles begin, and what each of them holds; no loop over samples that is not compiled.

A cycle is cut while the glottis is closed, in the middle of the longest closed time, or at the smallest area where it
never closes; likewise in a flow, a sound that is integrated, or a contact area instead of the area. A repeating wave is
cut on an even grid of its period; an irregular one at the minima of its slow part.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from vfcore.kernels.cycles import first_reached, lowest_each, refined_each, spaced_minima
from vfcore.measures.phonation import Phonation, Repetition
from vfcore.measures.pitch import Autocorrelation

# "Closed" means below this fraction of the cycle's peak area: closed in the plain sense, with room for rounding.
CLOSED_FRACTION = 1e-3
# Fewer cycles than this are no basis for an average.
MIN_CYCLES = 3


@dataclass(frozen=True)
class Cycles:
    """N consecutive whole cycles.

    ``marks``: shape (N + 1,), sub-sample positions of the cuts, in samples of the full wave.
    ``bounds``: shape (N + 1,), the same as whole samples; cycle k is ``[bounds[k], bounds[k+1])``.
    ``per_pattern``: cycles in one repeating pattern; N is a multiple of it.
    """

    marks: np.ndarray
    bounds: np.ndarray
    per_pattern: int = 1

    @property
    def count(self) -> int:
        return len(self.bounds) - 1

    @property
    def periods(self) -> np.ndarray:
        """Length of each cycle in samples, sub-sample; shape (N,)."""
        return np.diff(self.marks)

    def span(self, wave: np.ndarray) -> np.ndarray:
        """The samples of ``wave`` (full length) within these cycles, float64; of a float64 wave a view."""
        return wave[self.bounds[0] : self.bounds[-1]].astype(np.float64, copy=False)

    @cached_property
    def offsets(self) -> np.ndarray:
        """Where each cycle begins in ``span``, samples; shape (N,)."""
        return self.bounds[:-1] - self.bounds[0]

    def largest(self, wave: np.ndarray) -> np.ndarray:
        """Largest value in each cycle; shape (N,)."""
        return np.maximum.reduceat(self.span(wave), self.offsets)

    def smallest(self, wave: np.ndarray) -> np.ndarray:
        """Smallest value in each cycle; shape (N,)."""
        return np.minimum.reduceat(self.span(wave), self.offsets)

    def total(self, span: np.ndarray) -> np.ndarray:
        """Sum over each cycle of values given for the span; shape (N,)."""
        return np.add.reduceat(span, self.offsets)

    def where_largest(self, wave: np.ndarray) -> np.ndarray:
        """Sample of the full wave at which each cycle first reaches its largest value; shape (N,)."""
        wave, places = plain(wave), np.empty(self.count, dtype=np.int64)
        first_reached(wave, self.bounds, self.largest(wave), places)
        return places

    def between(self, peaks: np.ndarray) -> "Cycles":
        """The same cycles cut at one sample within each instead: one fewer, in whole patterns if possible."""
        whole = (len(peaks) - 1) // self.per_pattern * self.per_pattern or len(peaks) - 1
        peaks = peaks[len(peaks) - 1 - whole :]
        return Cycles(peaks.astype(np.float64), peaks, self.per_pattern)

    @property
    def representative(self) -> tuple[int, int]:
        """Sample bounds of one whole pattern to show: the latest of those nearest the median length."""
        edges = self.bounds[:: self.per_pattern]
        lengths = np.diff(edges)
        away = np.abs(lengths - np.median(lengths))
        k = len(away) - 1 - int(np.argmin(away[::-1]))
        return int(edges[k]), int(edges[k + 1])


def plain(wave: np.ndarray) -> np.ndarray:
    """``wave`` as compiled loops take it: float64, contiguous and writeable (read-only would be another type); copied
    only where it is not so already.
    """
    plain = np.ascontiguousarray(wave, dtype=np.float64)
    return plain if plain.flags.writeable else plain.copy()


def cut_cycles(
    wave: np.ndarray, start: int, phonation: Phonation, correlation: Autocorrelation | None = None
) -> Cycles | None:
    """The whole cycles of ``wave``, the measured part of a full one from its sample ``start`` on; None if too few can
    be followed.

    ``correlation``: that of ``wave``; None where it is the wave on which the phonation was judged.
    """
    found = phonation.repetition
    if found is None:
        return None
    wave, periodic = plain(wave), phonation.state == "periodic"
    marks = _even_marks(wave, found.pattern) if periodic else _followed_marks(wave, found, correlation)
    whole = (len(marks) - 1) // found.cycles_per_pattern * found.cycles_per_pattern
    if whole < MIN_CYCLES:
        return None
    marks = marks[len(marks) - 1 - whole :]
    if periodic:
        bounds = np.rint(marks).astype(np.int64)
    else:
        # Followed cycles are at least 0.6 cycle apart, so a reach of a quarter keeps the cuts in order.
        bounds = np.empty(len(marks), dtype=np.int64)
        lowest_each(wave, np.rint(marks).astype(np.int64), int(found.cycle / 4), bounds)
    return Cycles(marks + start, bounds + start, found.cycles_per_pattern)


def _even_marks(wave: np.ndarray, period: float) -> np.ndarray:
    """Cuts one period apart, placed by one cycle from the middle of the window."""
    length = int(np.ceil(period))
    first = (len(wave) - length) // 2
    one = wave[first : first + length]
    closed = one < CLOSED_FRACTION * one.max()
    origin = first + (_middle_of_longest_run(closed) if closed.any() else float(one.argmin()))
    return np.arange(origin % period, len(wave) - 1, period)


def _middle_of_longest_run(flags: np.ndarray) -> float:
    """Middle of the longest run of True, the array (not all True) taken as one turn of a circle."""
    first_open = int(np.argmin(flags))
    turned = np.roll(flags, -first_open)
    steps = np.diff(np.concatenate(([False], turned, [False])).astype(np.int8))
    begins, ends = np.flatnonzero(steps == 1), np.flatnonzero(steps == -1)
    k = int(np.argmax(ends - begins))
    return (0.5 * (begins[k] + ends[k] - 1) + first_open) % len(flags)


def _followed_marks(wave: np.ndarray, found: Repetition, correlation: Autocorrelation | None) -> np.ndarray:
    """Minima of the slow part of the wave, away from the ends of the window, where the filter sees too little."""
    slow = (correlation or found.correlation).slow_part(1.0 / found.cycle)
    minima = np.empty(len(slow) // 2, dtype=np.int64)
    minima = np.sort(minima[: spaced_minima(slow, max(int(0.6 * found.cycle), 1), minima)])
    margin = found.cycle / 2
    minima = minima[(minima > margin) & (minima < len(wave) - 1 - margin)]
    return refined_places(slow, minima)


def refined_places(wave: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Sub-sample positions of the extrema of ``wave`` at the samples ``places``, shape (N,)."""
    found = np.empty(len(places))
    refined_each(wave, places, found)
    return found
