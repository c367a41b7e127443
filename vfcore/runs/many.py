"""Many simulations reduced to their scalars, and many static shapes: what maps and sweeps are made of.

A request that fails yields its VocalisError in place of an answer and leaves the others alone.
"""

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby, islice
from typing import NamedTuple

import numpy as np

from vfcore.airways.coupled import airways_of, tract_of
from vfcore.airways.sound import measured_sound
from vfcore.airways.tract import Tract
from vfcore.errors import DivergenceError, ParameterError, VocalisError
from vfcore.fold.assemble import Glottis
from vfcore.fold.march_many import MarchInput, MarchResult, march_many
from vfcore.fold.stability import steps_to_try, time_step_s
from vfcore.fold.statics import static_shapes_of
from vfcore.larynx.posture.equilibrium import solve_each_posture
from vfcore.larynx.posture.solution import PostureSolution
from vfcore.measures.catalogue import MeasureReport, known_keys, measure_all
from vfcore.measures.signals import unused_samples, window_start
from vfcore.runs.batched_fft import BATCH, BatchedFFT
from vfcore.runs.one import Stop, signals_of, waveforms
from vfcore.runs.setup import GlottisSetup, glottis_of, mean_posture, postures_of
from vfcore.spec.sides import folds_of
from vfcore.spec.simulation import Simulation

BLOCK = 64  # requests per block, a multiple of the SIMD width of the step; bounds the memory of a long list
PRECISIONS = ("float64", "float32")
#: How far single precision is from double, by ``python -m tests.support.equivalence 300 float32``.
SINGLE_PRECISION = "periodic voices within 0.002 % in f_o, 0.02 % in mean flow and 0.05 % in peak contact pressure"


class Point(NamedTuple):
    """One simulation of many: its posture and measures."""

    posture: PostureSolution
    report: MeasureReport


class _Postured(NamedTuple):
    """A request with its glottis in its posture, before its static shape is known."""

    request: Simulation
    postures: tuple[PostureSolution, ...]
    glottis: Glottis


Keys = tuple[str, ...] | None


def run_points(
    requests: Sequence[Simulation],
    stop: Stop | None = None,
    *,
    measures: Sequence[str] | None = None,
    precision: str = "float64",
) -> Iterator[Point | VocalisError]:
    """Run the requests and yield, in their order, the Point of each or the error that left it without one.

    ``measures``: the keys wanted, None for all of the catalogue. ``precision``: "float64" or "float32" of march and
    transforms. A point is the same, bit for bit,
    whatever other points there are. ``stop()`` is called between chunks of voice; Cancelled is raised once it returns
    true. Raises ParameterError for an unknown measure or precision.
    """
    if precision not in PRECISIONS:
        raise ParameterError("precision", f"{precision!r} is not known", " | ".join(PRECISIONS))
    keys = None if measures is None else known_keys(measures)
    return _points(requests, stop, keys, precision == "float32")


def static_shapes(requests: Sequence[Simulation]) -> Iterator[GlottisSetup | VocalisError]:
    """Posture, glottis and static shape of each request, in order, or the error that says why there is none."""
    for found in _postured(requests):
        if isinstance(found, VocalisError):
            yield found
            continue
        try:
            yield GlottisSetup(found.postures, found.glottis, static_shapes_of(found.glottis))
        except VocalisError as error:
            yield error


def _points(
    requests: Sequence[Simulation], stop: Stop | None, keys: Keys, single_precision: bool
) -> Iterator[Point | VocalisError]:
    postured = _postured(requests)
    while block := list(islice(postured, BLOCK)):
        done: dict[int, Point | VocalisError] = {}
        inputs: dict[int, MarchInput] = {}
        marching: dict[int, _Postured] = {}
        for place, found in enumerate(block):
            try:
                if isinstance(found, VocalisError):
                    done[place] = found
                else:
                    marching[place] = found
                    inputs[place] = _march_input(found, time_step_s(found.request.run, found.glottis))
            except VocalisError as error:
                done[place] = error
        following = 0
        while inputs:
            places, again = list(inputs), dict[int, MarchInput]()
            outcomes = march_many(list(inputs.values()), single_precision=single_precision, stop=stop)
            marched = _at_their_step(((places[index], outcome) for index, outcome in outcomes), inputs, marching, again)
            for place, point in (_batched if single_precision else _one_by_one)(marched, keys):
                done[place] = point
                while following in done:
                    yield done.pop(following)
                    following += 1
            inputs = again
        for place in sorted(done):
            yield done[place]


def _at_their_step(
    outcomes: Iterable[tuple[int, MarchResult | DivergenceError]],
    inputs: dict[int, MarchInput],
    marching: dict[int, _Postured],
    again: dict[int, MarchInput],
) -> Iterator["_Marched"]:
    """The outcomes that count, by place. A march that diverged and has a shorter step to try goes to ``again``."""
    for place, outcome in outcomes:
        found = marching[place]
        if isinstance(outcome, DivergenceError):
            steps = steps_to_try(found.request.run, found.glottis)
            shorter = [step_s for step_s in steps if step_s < 0.75 * inputs[place].time_step_s]
            if shorter:
                again[place] = _march_input(found, shorter[0])
                continue
        yield place, found, outcome


def _march_input(found: _Postured, step_s: float) -> MarchInput:
    run, glottis = found.request.run, found.glottis
    start = static_shapes_of(glottis) if run.start == "static" else None
    airways = airways_of(found.request, step_s)
    pressure_pa = found.request.subglottal_pressure_pa
    given = MarchInput(glottis, step_s, pressure_pa, run.duration_s, run.pressure_rise_s, start, 0, airways)
    return given._replace(flow_only_samples=unused_samples(round(run.duration_s / given.sample_s), given.sample_s))


#: Place in the block, the glottis, and the result of its march.
_Marched = tuple[int, _Postured, MarchResult | DivergenceError]


def _one_by_one(marched: Iterable[_Marched], keys: Keys) -> Iterator[tuple[int, Point | VocalisError]]:
    for place, found, outcome in marched:
        yield place, _reduced(found, outcome, keys)


def _batched(marched: Iterable[_Marched], keys: Keys) -> Iterator[tuple[int, Point | VocalisError]]:
    """The same with shared transforms of neighbours that are alike; those without a sound are reduced alone."""
    for kind, neighbours in groupby(marched, _likeness):
        while group := list(islice(neighbours, BATCH)):
            batch = kind and BatchedFFT([run for _, _, run in group if isinstance(run, MarchResult)], kind[0])
            for nth, (place, found, outcome) in enumerate(group):
                yield place, _reduced(found, outcome, keys, (batch, nth) if batch else None)


def _likeness(one: _Marched) -> tuple[Tract, float, int, int] | None:
    """Tract, sampling interval and lengths, the same for runs that share transforms; None where there is no sound."""
    _, found, outcome = one
    if isinstance(outcome, DivergenceError) or not np.isfinite(outcome.flow_m3_s).all():
        return None
    return tract_of(found.request), outcome.sample_s, len(outcome.flow_m3_s), len(outcome.record)


def _reduced(
    found: _Postured,
    outcome: MarchResult | DivergenceError,
    keys: Keys,
    shared: tuple[BatchedFFT, int] | None = None,
) -> Point | VocalisError:
    """``shared``: the transforms of the batch of the run, and its place in it."""
    if isinstance(outcome, DivergenceError):
        return outcome
    record, flow_m3_s, sample_s = outcome
    left_out = len(flow_m3_s) - len(record)
    if shared:
        batch, nth = shared
        radiate, correlate = (lambda: batch.sounds[nth]), (lambda: batch.correlations[nth])
    else:
        radiate, correlate = (lambda: measured_sound(found.request, flow_m3_s, sample_s, left_out)), None
    try:
        arrays = waveforms(record, sample_s, found.glottis.form())
        measured_from = window_start(len(flow_m3_s)) - left_out
        signals = signals_of(found.request, found.postures, found.glottis, arrays, sample_s, measured_from)
        return Point(mean_posture(found.postures), measure_all(signals, keys, radiate, correlate))
    except VocalisError as error:
        return error


def _postured(requests: Sequence[Simulation]) -> Iterator[_Postured | VocalisError]:
    """The glottis of each request in order, or the error that left it without one."""
    source = iter(requests)
    while block := list(islice(source, BLOCK)):
        folds = [folds_of(request) for request in block]
        for request, sides, postures in zip(block, folds, _postures(folds), strict=True):
            if isinstance(postures, VocalisError):
                yield postures
                continue
            try:
                yield _Postured(request, postures, glottis_of(sides, postures))
            except VocalisError as error:
                yield error


def _postures(block: list[tuple[Simulation, ...]]) -> list[tuple[PostureSolution, ...] | VocalisError]:
    """The postures of each glottis. Single folds that are alike in their posturing constants are solved in one call,
    whose rows do not affect each other.
    """
    found: dict[int, tuple[PostureSolution, ...] | VocalisError] = {}
    alike: dict[tuple, list[int]] = {}
    for place, folds in enumerate(block):
        if len(folds) == 1 and folds[0].posture is None:
            alike.setdefault((folds[0].posturing, folds[0].constants.L_0_m), []).append(place)
            continue
        try:
            found[place] = postures_of(folds)
        except VocalisError as error:
            found[place] = error
    for (posturing, length), places in alike.items():
        try:
            solved = solve_each_posture([block[place][0].activation for place in places], posturing, length)
            for place, one in zip(places, solved, strict=True):
                found[place] = one if isinstance(one, VocalisError) else (one,)
        except VocalisError as error:
            found |= dict.fromkeys(places, error)
    return [found[place] for place in range(len(block))]
