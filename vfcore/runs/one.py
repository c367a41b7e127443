"""One run: from muscles to posture, vibration, pressures, measures and sound."""

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import version
from typing import NamedTuple

import numpy as np

from vfcore.airways.coupled import airways_of
from vfcore.airways.sound import whole_sound
from vfcore.errors import DivergenceError
from vfcore.fold.assemble import Fold, assemble
from vfcore.fold.march import TimeMarch
from vfcore.fold.stability import longest_stable_step_s, time_step_s
from vfcore.fold.statics import StaticShape, static_shape_of
from vfcore.kernels.layout import RECORD
from vfcore.larynx.posture.equilibrium import solve_posture
from vfcore.larynx.posture.solution import PostureSolution
from vfcore.larynx.tissue.coefficients import Coefficients, coefficients
from vfcore.measures.catalogue import MeasureReport, measure_all
from vfcore.measures.signals import Signals
from vfcore.runs.error_estimate import REFINEMENTS, Level, companion_step_s, companions, richardson, without_bars
from vfcore.runs.result import Provenance, SimulationResult
from vfcore.spec.simulation import Simulation
from vfcore.version import CODE_VERSION, MODEL_VERSION

PHASES = 100  # of the stored cycle
UNREPEATED_S = 0.010  # what the cycle arrays hold when nothing repeats
Progress = Callable[[float], None]
Stop = Callable[[], bool]


class FoldSetup(NamedTuple):
    """Posture, fold and static shape of a request, before anything moves."""

    posture: PostureSolution
    fold: Fold
    static: StaticShape


def posture_of(request: Simulation) -> PostureSolution:
    """The posture of a request: solved from the muscles, or given directly."""
    L_0 = request.constants.L_0_m
    given = request.posture
    if given is None:
        return solve_posture(request.activation, request.posturing, L_0)
    half_gap = np.tan(given.glottal_half_angle_rad) * L_0 * (1.0 + given.strain)
    nan = float("nan")
    return PostureSolution(
        given.strain, given.glottal_half_angle_rad, given.glottal_half_angle_rad, L_0 * (1.0 + given.strain),
        float(half_gap), nan, nan, nan, nan, nan, residual=0.0, converged=True,
    )  # fmt: skip


def prepare(request: Simulation, modify: Callable[[Coefficients], Coefficients] = lambda c: c) -> FoldSetup:
    """Posture, prestrained coefficients and static shape of a request (milliseconds).

    ``modify`` may change the coefficients before the fold is made of them: for studies of what the paper leaves open.
    Raises PostureError, ParameterError or StaticShapeError.
    """
    posture = posture_of(request)
    fold = fold_of(request, posture, modify)
    return FoldSetup(posture, fold, static_shape_of(fold))


def fold_of(
    request: Simulation, posture: PostureSolution, modify: Callable[[Coefficients], Coefficients] = lambda c: c
) -> Fold:
    """The prestrained fold of a request in its posture. Raises ParameterError where it has no stiffness left."""
    rest_angle = request.posture.rest_angle_rad if request.posture else request.constants.rest_angle_rad
    c = modify(coefficients(posture.strain, request.activation.ta, request.constants))
    return assemble(request, c, posture.glottal_half_angle_rad, rest_angle)


def static_shape(request: Simulation) -> StaticShape:
    """The fold at zero lung pressure: a direct solve with contact."""
    return prepare(request).static


def simulate(
    request: Simulation,
    progress: Progress | None = None,
    stop: Stop | None = None,
    prepared_by: Callable[[Simulation], FoldSetup] = prepare,
) -> SimulationResult:
    """Run a request; with ``run.error_estimate`` also its two finer companions (vfcore.runs.error_estimate).

    ``prepared_by`` makes the folds; other than ``prepare`` only for studies of what the paper leaves open.
    ``progress(fraction)`` is called after each chunk of at most 40 ms of voice, ``stop()`` before each. Raises
    ParameterError (StabilityError) for a request that cannot be run, PostureError, DivergenceError, and Cancelled once
    ``stop()`` is true.
    """
    if not request.run.error_estimate:
        return _run(request, progress, stop, prepared_by(request))
    return _run_with_companions(request, progress, stop, prepared_by)


def _run(
    request: Simulation, progress: Progress | None, stop: Stop | None, setup: FoldSetup, step_s: float | None = None
) -> SimulationResult:
    """One run, with the time step ``step_s`` or the request's own."""
    fold, run = setup.fold, request.run
    step_s = step_s or time_step_s(run, fold)
    airways = airways_of(request, step_s)
    march = TimeMarch(fold, step_s, request.subglottal_pressure_pa, run.pressure_rise_s, airways)
    march.start_static(setup.static) if run.start == "static" else march.start_flat()
    sample_s = march.time_step_s * march.record_every
    samples = round(run.duration_s / sample_s)
    began = time.perf_counter()
    record = march.run(samples, progress, stop)
    kernel_seconds = time.perf_counter() - began

    arrays = waveforms(record, sample_s, fold.nx)
    sound = whole_sound(request, arrays["glottal_flow_m3_s"], sample_s)
    arrays |= {"radiated_pressure_pa": sound.lip_pressure_pa, "far_pressure_pa": sound.far_pressure_pa}
    report = measure_all(signals_of(request, setup.posture, fold, arrays, sample_s), radiate=lambda: sound)
    first, last, complete = _cycle_bounds(report, march, samples, sample_s)
    arrays |= {
        "x_m": fold.x_m,
        "y_m": fold.y_m,
        "medial_plane_m": fold.medial_plane_m.T,
        "static_w_m": setup.static.w_m.T,
        "static_wb_m": setup.static.w_b,
    }
    arrays |= march.cycle(first, last, PHASES)
    return SimulationResult(
        request=request,
        posture=setup.posture,
        coefficients=fold.coefficients,
        static=setup.static,
        report=report,
        arrays=arrays,
        cycle_is_complete=complete,
        provenance=_provenance(march, sample_s, kernel_seconds),
    )


def steps_of(request: Simulation, folds: Sequence[Fold]) -> list[float]:
    """Time steps in force, s, of a request and of its companions, if any, on their folds."""
    own = time_step_s(request.run, folds[0])
    finer = zip(REFINEMENTS, folds[1:], strict=False)
    return [own, *(companion_step_s(own, by, longest_stable_step_s(fold)) for by, fold in finer)]


def _run_with_companions(
    request: Simulation, progress: Progress | None, stop: Stop | None, prepared_by: Callable[[Simulation], FoldSetup]
) -> SimulationResult:
    """The run itself and its companions; progress is shared in proportion to their work."""
    requests = (request, *companions(request))
    setups = [prepared_by(one) for one in requests]
    steps = steps_of(request, [setup.fold for setup in setups])
    work = np.cumsum([0.0] + [one.run.nx * one.run.ny / step for one, step in zip(requests, steps, strict=True)])
    work /= work[-1]

    def run(k: int) -> SimulationResult:
        shared = progress and (lambda part: progress(work[k] + part * (work[k + 1] - work[k])))
        return _run(requests[k], shared, stop, setups[k], steps[k])

    result = run(0)
    levels, reports = [_level(request, steps[0], result)], [result.report]
    for k, one in enumerate(requests[1:], start=1):
        try:
            found = run(k)
        except DivergenceError:
            reason = f"The companion on {one.run.nx} × {one.run.ny} nodes diverges."
            return replace(result, error_estimate=without_bars(levels, reason))
        reports.append(found.report)
        levels.append(_level(one, steps[k], found))
    return replace(result, error_estimate=richardson(levels, reports))


def _level(request: Simulation, step_s: float, result: SimulationResult) -> Level:
    return Level(request.run.nx, request.run.ny, step_s, result.report.state)


def waveforms(record: np.ndarray, sample_s: float, nx: int) -> dict[str, np.ndarray]:
    """The waveforms by name, (samples,) each, float64, of a record of the first columns of layout.RECORD: all but the
    sound. ``contact_location`` is x/L of the largest contact pressure, NaN without contact.
    """
    waves = {"time_s": np.arange(len(record)) * sample_s}
    for name, column in zip(RECORD, record.T, strict=False):
        wave = np.ascontiguousarray(column, np.float64)
        if name == "contact_column":
            waves["contact_location"] = wave / (nx - 1)
        else:
            waves[name] = wave
    return waves


def signals_of(
    request: Simulation,
    posture: PostureSolution,
    fold: Fold,
    arrays: dict[str, np.ndarray],
    sample_s: float,
    measured_from: int | None = None,
) -> Signals:
    """The signals of a run for its measures: its ``waveforms`` and numbers, without the sound."""
    c = fold.coefficients
    return Signals(
        sample_rate_hz=1.0 / sample_s,
        glottal_area_m2=arrays["glottal_area_m2"],
        glottal_flow_m3_s=arrays["glottal_flow_m3_s"],
        contact_pressure_max_pa=arrays["contact_pressure_max_pa"],
        contact_location=arrays["contact_location"],
        contact_area_m2=arrays["contact_area_m2"],
        subglottal_pressure_pa=request.subglottal_pressure_pa,
        length_m=c.length_m,
        strain=posture.strain,
        glottal_half_angle_rad=posture.glottal_half_angle_rad,
        gap_m=2.0 * c.length_m * np.tan(posture.glottal_half_angle_rad),
        medial_area_m2=c.length_m * c.thickness_m,
        air_density_kg_m3=request.constants.rho_a_kg_m3,
        sound_speed_m_s=request.constants.c_a_m_s,
        measured_from=measured_from,
    )


def _cycle_bounds(report: MeasureReport, march: TimeMarch, samples: int, sample_s: float) -> tuple[int, int, bool]:
    """First and last sample of the cycle to store, moved to the last whole one that can be read back."""
    if report.cycle_bounds is None:
        return max(samples - round(UNREPEATED_S / sample_s), march.oldest_sample), samples, False
    first, last = report.cycle_bounds
    if first >= march.oldest_sample:
        return first, last, True
    return max(samples - (last - first), march.oldest_sample), samples, True


@cache
def _numba_version() -> str:
    return version("numba")


def _provenance(march: TimeMarch, sample_s: float, kernel_seconds: float) -> Provenance:
    return Provenance(
        model_version=MODEL_VERSION,
        code_version=CODE_VERSION,
        numba_version=_numba_version(),
        numpy_version=np.__version__,
        created=datetime.now(UTC).isoformat(timespec="seconds"),
        time_step_s=march.time_step_s,
        sample_rate_hz=1.0 / sample_s,
        kernel_seconds=kernel_seconds,
    )
