"""Differential evolution in the unit cube, one generation at a time; the result of a seed does not depend on workers.

Each point of the population moves part of the way to one of the best and along the difference of two others ("current
to p-best", Zhang & Sanderson 2009). A better point replaces the old one. A trial gets the value it has to beat, so that
it can stop early.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple, Protocol

import numpy as np

#: Share of the population that counts as best, length of a move, share of the coordinates that move.
BEST, STEP, MOVED = 0.15, (0.4, 0.8), 0.8


class Tried(Protocol):
    """The result of a trial."""

    @property
    def total(self) -> float: ...


class Generation(NamedTuple):
    """The points, (n, factors), and the result of each."""

    points: np.ndarray
    tried: list


Try = Callable[[Iterable[np.ndarray], Sequence[float]], list]


def evolve(first: np.ndarray, attempt: Try, generations: int, seed: int) -> Iterator[Generation]:
    """Yield the generations, starting with ``first``. ``attempt(points, limits)`` tries points against the values to
    beat.
    """
    rng = np.random.default_rng(seed)
    points = first.copy()
    tried = attempt(points, [float("inf")] * len(points))
    yield Generation(points.copy(), list(tried))
    for _ in range(generations):
        limits = [one.total for one in tried]
        moved = _moved(points, np.argsort(limits, kind="stable"), rng)
        for k, one in enumerate(attempt(moved, limits)):
            if one.total < limits[k]:
                points[k], tried[k] = moved[k], one
        yield Generation(points.copy(), list(tried))


def _moved(points: np.ndarray, order: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    count, width = points.shape
    best = order[: max(3, round(BEST * count))]
    moved = points.copy()
    for k in range(count):
        towards = points[rng.choice(best)]
        one, other = points[rng.choice(count, 2, replace=False)]
        step = rng.uniform(*STEP)
        there = points[k] + step * (towards - points[k]) + step * (one - other)
        # Out of bounds: take a point between the old one and the bound.
        back = rng.random(width)
        there = np.where(there < 0, back * points[k], np.where(there > 1, 1 - back * (1 - points[k]), there))
        moved[k] = np.where(rng.random(width) < MOVED, there, points[k])
    return moved
