"""The cost of a sweep, and the size of its tasks."""

import threading
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product
from typing import Any

from vfcore.errors import ParameterError
from vfcore.fold.form import LANES
from vfcore.runs.cost import node_steps, walls_of
from vfcore.runs.sweep.plan import Sweep
from vfcore.spec.declarations import SIDES
from vfcore.spec.paths import DECLARATIONS, NUMBERS, value_at

_OF_RUN = frozenset(path for path in NUMBERS if DECLARATIONS[path].part == "run")
LESIONS = "lesions"
TASK_S = (0.2, 1.0)  # long against the round trip, short enough that a lost or stopped task costs little
TASKS_PER_WORKER = 8  # at least so many, so that all workers finish at about the same time
MOST_PER_TASK = 512
_GUESS_S = 3e-9  # first guess per node and step: twice the time of an idle core
_OVERHEAD_S = 2e-3  # per point: posture, coefficients, measures


def point_node_steps(sweep: Sweep) -> float:
    """Upper bound of the node-steps of one point; steps that stability shortens are not counted."""
    extremes = {DECLARATIONS[path].name: _extremes(values) for path, values in _varied_of_run(sweep).items()}
    corners: Iterator[dict[str, Any]] = (dict(zip(extremes, one, strict=True)) for one in product(*extremes.values()))
    base, parts = sweep.base, _varied_parts(sweep)
    patched = bool(base.lesions) or LESIONS in parts
    # Sides that are alike in the base, or a lesion of one side without effect there, may differ in a point.
    one_sided = any(one.side in SIDES for one in base.lesions)
    given = base.left is not None or base.right is not None or one_sided
    apart = given or not parts.isdisjoint(SIDES)
    walls = 2 if apart else walls_of(base)
    runs = (replace(base.run, **corner) for corner in corners)
    return max(node_steps(base, run, run.step_s, walls, patched) for run in runs)


def _varied_parts(sweep: Sweep) -> set[str]:
    """The outermost part of every path that is varied."""
    paths = {path for axis in sweep.axes for path in axis.parameters} | {
        path for point in sweep.points for path in point
    }
    return {path.partition(".")[0] for path in paths}


def check_cost(sweep: Sweep, points: int, node_steps: float, setting_points: str, setting_steps: str) -> None:
    """ParameterError when a sweep has more than ``points`` points or ``node_steps`` nodes × steps in all."""
    path = "axes" if sweep.axes else "points"
    if len(sweep) > points:
        raise ParameterError(path, f"{len(sweep)} points are too many", f"up to {points} points ({setting_points})")
    total = point_node_steps(sweep) * len(sweep)
    if total > node_steps:
        raise ParameterError(
            path,
            f"{len(sweep)} runs are up to {total:.2g} node-steps",
            f"up to {node_steps:g} node-steps ({setting_steps}): fewer points, shorter runs or a coarser grid",
        )


def _extremes(values: Sequence[float | None]) -> set[float | None]:
    """The least and the largest number, and null where it is among them."""
    numbers = [value for value in values if value is not None]
    return {*values} - {*numbers} | ({min(numbers), max(numbers)} if numbers else set())


def _varied_of_run(sweep: Sweep) -> dict[str, Sequence[float | None]]:
    """The values that numbers of the run take, by path."""
    if sweep.axes:
        return {path: axis.values for axis in sweep.axes for path in axis.parameters if path in _OF_RUN}
    varied = {path for point in sweep.points for path in point if path in _OF_RUN}
    return {path: [point.get(path, value_at(sweep.base, path)) for point in sweep.points] for path in varied}


class Portions:
    """The number of points of the next task, learned from the tasks done so far. Thread-safe."""

    def __init__(self, sweep: Sweep, workers: int):
        self._points, self.workers = len(sweep), workers
        self._lanes = LANES[sweep.precision]
        self._point_s = _OVERHEAD_S + _GUESS_S * point_node_steps(sweep)
        self._lock = threading.Lock()

    def next_size(self, left: int) -> int:
        """Points of a task of 0.2 to 1 s: whole batches where one fits, at most a fair share of the ``left`` points."""
        with self._lock:
            workers, total_s = max(1, self.workers), self._point_s * self._points
            wanted_s = min(max(total_s / (workers * TASKS_PER_WORKER), TASK_S[0]), TASK_S[1])
            share = max(left / workers, self._lanes)
            size = max(1, round(min(wanted_s / self._point_s, share, MOST_PER_TASK)))
            return size if size < self._lanes else round(size / self._lanes) * self._lanes

    def learn(self, points: int, seconds: float) -> None:
        """Record that a task of ``points`` took ``seconds``. The first may include compilation; later ones correct
        it.
        """
        with self._lock:
            self._point_s += 0.5 * (max(seconds / points, 1e-5) - self._point_s)
