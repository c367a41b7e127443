"""Many simulations reduced to their scalars, and many static shapes: what maps and sweeps are made of."""

from collections.abc import Callable, Iterator, Sequence
from itertools import islice
from typing import NamedTuple

from vfcore.assemble import Fold
from vfcore.errors import Cancelled, VocalisError
from vfcore.march import March
from vfcore.measures.catalogue import MeasureReport, known_keys, measure_all
from vfcore.params import Simulation
from vfcore.posture.equilibrium import solve_each_posture
from vfcore.posture.solution import PostureSolution
from vfcore.simulate import Prepared, fold_of, measured_sound, posture_of, signals_of, waveforms
from vfcore.stability import time_step_s
from vfcore.statics import static_shape_of

BLOCK = 64  # requests whose postures are solved together; bounds the memory of a long list


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
) -> Iterator[Point]:
    """Run the requests and yield one Point each, in their order.

    ``measures``: the keys wanted, None for all of the catalogue. Each number equals that of ``simulate`` bit for bit.
    ``stop()`` is asked between chunks of voice; Cancelled is raised when it answers true. Any other error belongs to
    its point and leaves the others alone. Raises ParameterError for an unknown measure.
    """
    keys = None if measures is None else known_keys(measures)
    return _points(requests, stop, keys)


def static_shapes(requests: Sequence[Simulation]) -> Iterator[Prepared | VocalisError]:
    """Posture, fold and static shape of each request, in order, or the error that says why there is none."""
    for _, (posture, found) in _folds(requests):
        if isinstance(found, Fold):
            try:
                yield Prepared(posture, found, static_shape_of(found))
            except VocalisError as error:
                yield error
        else:
            yield found


def _points(requests, stop, keys) -> Iterator[Point]:
    for request, (posture, found) in _folds(requests):
        if isinstance(found, Fold):
            try:
                yield Point(posture, _report(request, posture, found, stop, keys), None)
            except Cancelled:
                raise
            except VocalisError as error:
                yield Point(None, None, error)
        else:
            yield Point(None, None, found)


def _report(request: Simulation, posture: PostureSolution, fold: Fold, stop, keys) -> MeasureReport:
    run = request.run
    march = March(fold, time_step_s(run, fold), request.subglottal_pressure_pa, run.pressure_rise_s)
    march.start_static(static_shape_of(fold)) if run.start == "static" else march.start_flat()
    sample_s = march.time_step_s * march.record_every
    arrays = waveforms(march.run(round(run.duration_s / sample_s), None, stop), sample_s, fold.nx)
    return measure_all(
        signals_of(request, posture, fold, arrays, sample_s),
        keys,
        radiate=lambda: measured_sound(request, arrays["glottal_flow_m3_s"], sample_s),
    )


def _folds(requests: Sequence[Simulation]):
    """(request, (posture, fold)) of each in order; (None, error) in place of those that have none."""
    source = iter(requests)
    while block := list(islice(source, BLOCK)):
        postures = _postures(block)
        for request, posture in zip(block, postures, strict=True):
            if isinstance(posture, VocalisError):
                yield request, (None, posture)
                continue
            try:
                yield request, (posture, fold_of(request, posture))
            except VocalisError as error:
                yield request, (None, error)


def _postures(block: list[Simulation]) -> list[PostureSolution | VocalisError]:
    """Those alike in their posturing constants are solved in one call, whose rows do not see each other."""
    found: list = [None] * len(block)
    alike: dict[tuple, list[int]] = {}
    for place, request in enumerate(block):
        if request.posture is None:
            alike.setdefault((request.posturing, request.constants.L_0_m), []).append(place)
        else:
            found[place] = posture_of(request)
    for (posturing, length), places in alike.items():
        try:
            solved = solve_each_posture([block[place].activation for place in places], posturing, length)
        except VocalisError as error:
            solved = [error] * len(places)
        for place, posture in zip(places, solved, strict=True):
            found[place] = posture
    return found
