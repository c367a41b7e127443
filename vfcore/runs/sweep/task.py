"""One task of a sweep: some of its points, computed together by one process."""

import time
from collections.abc import Callable
from typing import NamedTuple

from vfcore.errors import Cancelled, ParameterError, VocalisError
from vfcore.runs.many import Point, run_points
from vfcore.runs.one import simulate
from vfcore.runs.result import SimulationResult
from vfcore.runs.sweep.plan import Sweep
from vfcore.runs.sweep.row import Row, columns, row_of
from vfcore.spec.simulation import Simulation
from vfcore.version import MODEL_VERSION

Stop = Callable[[], bool]


class WrongModel(VocalisError):
    """The worker has another version of the model, whose results must not be mixed with the others."""


class TaskResult(NamedTuple):
    """Rows of the points of a task in order; full results by position if the sweep keeps waveforms; seconds taken."""

    rows: list[Row]
    results: dict[int, SimulationResult]
    seconds: float


def run_task(part: Sweep, model_version: str, stop: Stop | None = None) -> TaskResult:
    """Compute every point of ``part`` (see ``Sweep.part``).

    Raises WrongModel where this process has another model, and Cancelled once ``stop()`` is true.
    """
    if model_version != MODEL_VERSION:
        raise WrongModel(
            f"A worker has model {MODEL_VERSION}, the sweep needs model {model_version}: "
            "install the same version of Vocalis on both."
        )
    began = time.perf_counter()
    keys = list(columns(part))
    points: dict[int, Point | VocalisError] = {}
    requests: dict[int, Simulation] = {}
    for position in range(len(part)):
        try:
            requests[position] = part.request(position)
        except ParameterError as error:
            points[position] = error
    results: dict[int, SimulationResult] = {}
    if part.keep_waveforms:
        for position, request in requests.items():
            points[position] = _whole(request, position, results, stop)
    else:
        found = run_points(list(requests.values()), stop, measures=part.measures, precision=part.precision)
        points |= zip(requests, found, strict=True)
    rows = [row_of(points[position], keys) for position in range(len(part))]
    return TaskResult(rows, results, time.perf_counter() - began)


def _whole(
    request: Simulation, position: int, results: dict[int, SimulationResult], stop: Stop | None
) -> Point | VocalisError:
    try:
        results[position] = result = simulate(request, stop=stop)
    except Cancelled:
        raise
    except VocalisError as error:
        return error
    return Point(result.posture, result.report)
