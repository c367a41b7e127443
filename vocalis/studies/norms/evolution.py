"""Differential evolution in the unit cube, a generation at a time, the same for a seed on any number of workers.

Each point of the population is moved part of the way to one of the best and along the difference of two others
("current to p-best", Zhang & Sanderson 2009), and replaced where the moved point is the better one. A trial is told
the number it must stay below, so that it can end as soon as it no longer can.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple, Protocol

import numpy as np

#: Share of the population that counts as the best, length of a move, share of the coordinates that move.
BEST, STEP, MOVED = 0.15, (0.4, 0.8), 0.8


class Tried(Protocol):
    """What a trial comes back with."""

    @property
    def total(self) -> float: ...


class Generation(NamedTuple):
    """The points, (n, factors), and what each came back with."""

    points: np.ndarray
    tried: list


Try = Callable[[Sequence[np.ndarray], Sequence[float]], list]


def evolve(first: np.ndarray, attempt: Try, generations: int, seed: int) -> Iterator[Generation]:
    """The generations, the ``first`` points included. ``attempt(points, bars)`` tries points against bars."""
    rng = np.random.default_rng(seed)
    points = first.copy()
    tried = attempt(points, [float("inf")] * len(points))
    yield Generation(points.copy(), list(tried))
    for _ in range(generations):
        bars = [one.total for one in tried]
        moved = _moved(points, np.argsort(bars, kind="stable"), rng)
        for k, one in enumerate(attempt(moved, bars)):
            if one.total < bars[k]:
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
        # Beyond a wall: somewhere between the wall and where the point was.
        back = rng.random(width)
        there = np.where(there < 0, back * points[k], np.where(there > 1, 1 - back * (1 - points[k]), there))
        moved[k] = np.where(rng.random(width) < MOVED, there, points[k])
    return moved
