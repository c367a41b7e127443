"""A played gesture as data: the target of each block, as breakpoints from which the gesture can be rendered."""

from dataclasses import replace
from typing import Any

from vfcore.runs.gesture.gesture import Gesture, gesture_to_dict
from vfcore.runs.gesture.slew import differences
from vfcore.runs.gesture.track import Track
from vfcore.runs.gesture.voice import BLOCK_S
from vfcore.spec.declarations import SIDES
from vfcore.spec.paths import value_at
from vfcore.spec.simulation import Simulation

LONGEST_BLOCKS = 60_000  # 10 minutes


class Recording:
    """Records from the first block of a voice. Rendering its document gives the same samples."""

    def __init__(self, start: Simulation):
        self._start = self._last = start
        self._numbers: dict[str, list[tuple[int, float]]] = {}
        self._vowels: list[tuple[int, str]] = [(0, start.vowel)]
        self.blocks = 0

    def take(self, block: int, target: Simulation) -> None:
        """Block number ``block`` (from 1) has reached ``target``."""
        if block > LONGEST_BLOCKS:
            return
        self.blocks = block
        for path in self._moved(target):
            points = self._numbers.setdefault(path, self._so_far(path, block))
            if points[-1][0] < block - 1:  # it was constant until the block before
                points.append((block - 1, points[-1][1]))
            points.append((block, value_at(target, path)))
        if target.vowel != self._last.vowel:
            self._vowels.append((block, target.vowel))
        self._last = target

    def _moved(self, target: Simulation) -> list[str]:
        """The numbers that have moved since the last target; a number of a side may follow that of the request."""
        paths = dict.fromkeys(differences(self._last, target))
        on_side = (path for path in self._numbers if path.partition(".")[0] in SIDES)
        paths |= {path: None for path in on_side if value_at(self._last, path) != value_at(target, path)}
        return list(paths)

    def _so_far(self, path: str, block: int) -> list[tuple[int, float]]:
        """The points of a number that moves for the first time: a number of a side was that of the request before."""
        first, _, rest = path.partition(".")
        followed = self._numbers.get(rest, []) if first in SIDES else []
        return [point for point in followed if point[0] < block] or [(0, value_at(self._start, path))]

    def document(self) -> dict[str, Any]:
        """The gesture as a request document."""
        run = replace(self._start.run, duration_s=max(self.blocks * BLOCK_S, 0.02))
        tracks = tuple(
            Track(path, tuple(k * BLOCK_S for k, _ in points), tuple(value for _, value in points))
            for path, points in self._numbers.items()
        )
        vowels = tuple((k * BLOCK_S, vowel) for k, vowel in self._vowels) if len(self._vowels) > 1 else ()
        return gesture_to_dict(Gesture(replace(self._start, run=run), tracks, vowels))
