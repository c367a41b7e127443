"""Many simulations reduced to their scalars, and many static shapes: what maps and sweeps are made of."""

from collections.abc import Callable, Iterator, Sequence
from itertools import groupby, islice
from typing import NamedTuple

import numpy as np

from vfcore.airways.coupled import airways_of, tract_of
from vfcore.airways.sound import measured_sound
from vfcore.errors import DivergenceError, ParameterError, VocalisError
from vfcore.fold.assemble import Fold
from vfcore.fold.march import TimeMarch
from vfcore.fold.march_many import FLOW, MarchInput, MarchResult, march_many
from vfcore.fold.stability import time_step_s
from vfcore.fold.statics import static_shape_of
from vfcore.larynx.posture.equilibrium import solve_each_posture
from vfcore.larynx.posture.solution import PostureSolution
from vfcore.measures.catalogue import MeasureReport, known_keys, measure_all
from vfcore.measures.signals import unread, window_start
from vfcore.runs.batched_fft import TOGETHER, Together
from vfcore.runs.one import Prepared, fold_of, posture_of, signals_of, waveforms
from vfcore.spec.simulation import Simulation

BLOCK = 64  # requests taken together, a multiple of the lanes of the step; bounds the memory of a long list
PRECISIONS = ("float64", "float32")
#: How far single precision is from double, by ``python -m tests.support.equivalence 300 float32``.
SINGLE_PRECISION = "periodic voices within 0.002 % in f_o, 0.02 % in mean flow and 0.05 % in peak contact pressure"


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

    ``measures``: the keys wanted, None for all of the catalogue. ``precision``: "float64" or "float32" of march and
    transforms; points with two-way coupling march one by one, in double precision. A point is the same, bit for bit,
    whatever points run beside it. ``stop()`` is asked between chunks of voice; Cancelled is raised when it answers
    true. Any other error belongs to its point and leaves the others alone. Raises ParameterError for an unknown measure
    or precision.
    """
    if precision not in PRECISIONS:
        raise ParameterError("precision", f"{precision!r} is not known", " | ".join(PRECISIONS))
    keys = None if measures is None else known_keys(measures)
    return _points(requests, stop, keys, precision == "float32")


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


def _points(requests, stop, keys, single_precision) -> Iterator[Point]:
    folds = _folds(requests)
    while block := list(islice(folds, BLOCK)):
        done, motions = {}, {}
        for place, (request, (_, found)) in enumerate(block):
            try:
                if isinstance(found, VocalisError):
                    raise found
                if request.model.coupling == "one_way":
                    motions[place] = _motion(request, found)
                else:
                    done[place] = _reduced(request, block[place][1][0], found, _coupled(request, found, stop), keys)
            except VocalisError as error:
                done[place] = Point(None, None, error)
        places, following = list(motions), 0
        outcomes = march_many(list(motions.values()), single_precision=single_precision, stop=stop)
        marched = ((places[index], outcome) for index, outcome in outcomes)
        for place, point in (_side_by_side if single_precision else _one_by_one)(block, marched, keys):
            done[place] = point
            while following in done:
                yield done.pop(following)
                following += 1
        for place in sorted(done):
            yield done[place]


def _motion(request: Simulation, fold: Fold) -> MarchInput:
    run = request.run
    start = static_shape_of(fold) if run.start == "static" else None
    step_s = time_step_s(run, fold)
    motion = MarchInput(fold, step_s, request.subglottal_pressure_pa, run.duration_s, run.pressure_rise_s, start)
    return motion._replace(flow_only_samples=unread(round(run.duration_s / motion.sample_s), motion.sample_s))


def _coupled(request: Simulation, fold: Fold, stop) -> MarchResult | DivergenceError:
    """A fold coupled to its airways marches alone, and in double precision: each has its own tract in the loop."""
    motion = _motion(request, fold)
    beside = airways_of(request, motion.time_step_s)
    march = TimeMarch(fold, motion.time_step_s, motion.pressure_pa, motion.rise_s, beside)
    march.start_flat() if motion.start is None else march.start_static(motion.start)
    try:
        record = march.run(round(motion.duration_s / motion.sample_s), None, stop)
    except DivergenceError as error:
        return error
    return MarchResult(record, record[:, FLOW], motion.sample_s)


def _one_by_one(
    block, marched: Iterator[tuple[int, MarchResult | DivergenceError]], keys
) -> Iterator[tuple[int, Point]]:
    for place, outcome in marched:
        request, (posture, fold) = block[place]
        yield place, _reduced(request, posture, fold, outcome, keys)


def _side_by_side(
    block, marched: Iterator[tuple[int, MarchResult | DivergenceError]], keys
) -> Iterator[tuple[int, Point]]:
    """The same, neighbours that are alike measured together, and alone those without a sound."""

    def likeness(one: tuple[int, MarchResult | DivergenceError]):
        place, outcome = one
        if isinstance(outcome, DivergenceError) or not np.isfinite(outcome.flow_m3_s).all():
            return None
        return tract_of(block[place][0]), outcome.sample_s, len(outcome.flow_m3_s), len(outcome.record)

    for kind, neighbours in groupby(marched, likeness):
        while group := list(islice(neighbours, TOGETHER)):
            shared = kind and Together([run for _, run in group if isinstance(run, MarchResult)], kind[0])
            for nth, (place, outcome) in enumerate(group):
                request, (posture, fold) = block[place]
                yield place, _reduced(request, posture, fold, outcome, keys, shared and (shared, nth))


def _reduced(
    request: Simulation,
    posture: PostureSolution,
    fold: Fold,
    outcome: MarchResult | DivergenceError,
    keys,
    shared: tuple[Together, int] | None = None,
) -> Point:
    if isinstance(outcome, DivergenceError):
        return Point(None, None, outcome)
    flow_m3_s, sample_s = outcome.flow_m3_s, outcome.sample_s
    left_out = len(flow_m3_s) - len(outcome.record)
    if shared:
        together, nth = shared
        radiate, correlate = (lambda: together.sounds[nth]), (lambda: together.correlations[nth])
    else:
        radiate, correlate = (lambda: measured_sound(request, flow_m3_s, sample_s, left_out)), None
    try:
        arrays = waveforms(outcome.record, sample_s, fold.nx)
        signals = signals_of(request, posture, fold, arrays, sample_s, window_start(len(flow_m3_s)) - left_out)
        return Point(posture, measure_all(signals, keys, radiate, correlate), None)
    except VocalisError as error:
        return Point(None, None, error)


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
