"""From cases to evidence: runs the cases in worker processes.

A run without an answer (no posture, no static shape, divergence) is a ``Failure`` with the reason. It does not stop the
others: in a map or sweep it is a cell with state "failed"; a claim that needs this run alone fails with the reason.
"""

import time
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import asdict, replace
from multiprocessing import get_context
from typing import Any, NamedTuple

from vfcore.errors import VocalisError
from vfcore.measures.catalogue import CATALOGUE, MeasureReport
from vfcore.measures.measure import Measure
from vfcore.runs.many import run_points
from vfcore.runs.one import simulate
from vfcore.runs.setup import GlottisSetup, prepare
from vfcore.spec.simulation import PAPER_STEP_S, Simulation
from vocalis.studies.paper import evidence
from vocalis.studies.paper.cases import Case

FAILED = "failed"
LEVEL = "spl_lips_db"
#: Duration of a run that is just long enough to use every kernel, s.
WARM_UP_S = 0.02
Progress = Callable[[str, int, int], None]
#: A function from a request to its fold at rest.
Prepare = Callable[[Simulation], GlottisSetup]


class Failure(NamedTuple):
    """The reason why a run, or a case that needs it, has no answer."""

    reason: str


class Gathered(NamedTuple):
    """``evidence`` by case: a NamedTuple of ``vocalis.studies.paper.evidence``, or a Failure.

    ``failures``: every run without an answer, as (case, activations, reason).
    """

    evidence: dict[str, Any]
    failures: list[tuple[str, str, str]]


@contextmanager
def workers(count: int) -> Iterator[ProcessPoolExecutor]:
    """``count`` worker processes; on exit, queued runs are cancelled."""
    pool = ProcessPoolExecutor(count, mp_context=get_context("spawn"))
    try:
        yield pool
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def warm_up(request: Simulation) -> None:
    """Compile the kernels that ``request`` needs once, before all workers would."""
    with suppress(VocalisError):  # only compilation matters here; the runs report their own errors
        simulate(replace(request, run=replace(request.run, duration_s=WARM_UP_S, pressure_rise_s=0.0)))


def gather(
    cases: Mapping[str, Case],
    pool: ProcessPoolExecutor,
    progress: Progress = lambda case, done, total: None,
    level: str = LEVEL,
    fold: Prepare = prepare,
) -> Gathered:
    """All runs of the cases.

    ``progress(case, done, total)`` is called after each run. ``level``: the measure that is the level of a map.
    ``fold``: the function that makes the folds, importable by name. Timed cases run last, when the workers are idle.
    """
    begun = {key: _begin(case, pool, fold) for key, case in cases.items() if case.kind != "timing"}
    total, done = sum(map(len, begun.values())), 0
    found: dict[str, Any] = {}
    failures = []
    for key, futures in begun.items():
        answers = []
        for future in futures:
            answers.append(future.result())
            done += 1
            progress(key, done, total)
        found[key] = _EVIDENCE[cases[key].kind](cases[key], [_read_at(level, answer) for answer in answers])
        for request, answer in zip(cases[key].requests(), answers, strict=True):
            if isinstance(answer, Failure):
                failures.append((key, _activations(request), answer.reason))
    for key, case in cases.items():
        if case.kind == "timing":
            progress(key, done, total)
            found[key] = timing(case.requests()[0])
    return Gathered(found, failures)


def gather_here(cases: Mapping[str, Case]) -> dict[str, Any]:
    """Evidence of the cases, run in this process; maps and sweeps compute only the measures that claims read."""
    return {key: _EVIDENCE[case.kind](case, _answers(case)) for key, case in cases.items()}


def _answers(case: Case) -> list:
    if case.kind not in _READ:
        return [_answer(case.kind, request, prepare) for request in case.requests()]
    points = run_points(case.requests(), measures=_READ[case.kind])
    return [Failure(str(point)) if isinstance(point, VocalisError) else point.report for point in points]


def timing(own: Simulation) -> evidence.Timing | Failure:
    """Wall time of one warm call with the paper's step and with the step of ``own``."""
    try:
        warm_up(own)
        return evidence.Timing(
            own.run.duration_s, _seconds(replace(own, run=replace(own.run, time_step_s=PAPER_STEP_S))), _seconds(own)
        )
    except VocalisError as error:
        return Failure(str(error))


def _seconds(request: Simulation) -> float:
    began = time.perf_counter()
    simulate(request)
    return time.perf_counter() - began


def _activations(request: Simulation) -> str:
    return ", ".join(f"{muscle.upper()} {level:g}" for muscle, level in asdict(request.activation).items())


def _begin(case: Case, pool: ProcessPoolExecutor, fold: Prepare) -> list[Future]:
    return [pool.submit(_answer, case.kind, request, fold) for request in case.requests()]


def _answer(kind: str, request: Simulation, fold: Prepare):
    """One run, in a worker: the data for its kind of evidence."""
    try:
        if kind == "static":
            return fold(request).static
        result = simulate(request, prepared_by=fold)
    except VocalisError as error:
        return Failure(str(error))
    return evidence.voice_cycle(result) if kind == "voice" else result.report


def _static(case: Case, answers: list) -> evidence.StaticSeries | Failure:
    (axis,) = case.axes
    for level, answer in zip(axis.levels, answers, strict=True):
        if isinstance(answer, Failure):
            return Failure(f"{' = '.join(axis.muscles).upper()} {level:g}: {answer.reason}")
    return evidence.static_series(axis.levels, answers)


def _voice(case: Case, answers: list) -> evidence.VoiceCycle | Failure:
    return answers[0]


def _map(case: Case, answers: list) -> evidence.ActivationMap:
    ct, ta = (axis.levels for axis in case.axes)
    return evidence.activation_map(ct, ta, [_report(answer) for answer in answers])


def _sweep(case: Case, answers: list) -> evidence.PcaSweep:
    (axis,) = case.axes
    return evidence.pca_sweep(axis.levels, [_report(answer) for answer in answers])


def _read_at(level: str, answer):
    """A report with another measure as its level; any other answer unchanged."""
    if not isinstance(answer, MeasureReport):
        return answer
    return replace(answer, measures=answer.measures | {LEVEL: answer.measures[level]})


def _report(answer: MeasureReport | Failure) -> MeasureReport:
    if isinstance(answer, MeasureReport):
        return answer
    missing = {spec.key: Measure(None, spec.unit, answer.reason) for spec in CATALOGUE}
    return MeasureReport(FAILED, answer.reason, None, missing, 0, None)


_READ = {"map": evidence.MAP_MEASURES, "sweep": evidence.SWEEP_MEASURES}
_EVIDENCE = {"static": _static, "voice": _voice, "map": _map, "sweep": _sweep}
