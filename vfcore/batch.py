"""Many simulations reduced to their scalars: what a sweep stores of each point."""

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from vfcore.errors import Cancelled, ParameterError, VocalisError
from vfcore.measures.catalogue import MeasureReport
from vfcore.params import Simulation
from vfcore.posture.solution import PostureSolution
from vfcore.simulate import simulate


class Point(NamedTuple):
    """One simulation of many: its posture and measures, or the ``problem`` that left it without an answer."""

    posture: PostureSolution | None
    report: MeasureReport | None
    problem: VocalisError | None


def run_points(
    requests: Sequence[Simulation],
    stop: Callable[[], bool] | None = None,
    *,
    measures: Sequence[str] | None = None,
    precision: str = "float64",
) -> Iterator[Point]:
    """Run the requests and yield one Point each, in their order.

    ``measures``: the keys wanted, None for all; others may be there too. ``precision``: there is one only.

    ``stop()`` is asked between chunks of voice; Cancelled is raised when it answers true. Any other error
    belongs to its point and leaves the others alone.
    """
    if precision != "float64":
        raise ParameterError("precision", f"{precision!r} is not offered", "float64")
    return _points(requests, stop)


def _points(requests: Sequence[Simulation], stop: Callable[[], bool] | None) -> Iterator[Point]:
    for request in requests:
        try:
            result = simulate(request, stop=stop)
        except Cancelled:
            raise
        except VocalisError as error:
            yield Point(None, None, error)
        else:
            yield Point(result.posture, result.report, None)
