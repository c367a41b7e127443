"""One run: from muscles to posture, vibration, pressures, measures and sound."""

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import version

import numpy as np

from vfcore.airways.coupled import airways_of
from vfcore.airways.sound import whole_sound
from vfcore.errors import DivergenceError
from vfcore.fold.assemble import Glottis
from vfcore.fold.form import StepForm
from vfcore.fold.march import TimeMarch
from vfcore.fold.stability import longest_stable_step_s, steps_to_try, time_step_s
from vfcore.larynx.posture.solution import PostureSolution
from vfcore.measures.catalogue import MeasureReport, measure_all
from vfcore.measures.signals import Signals
from vfcore.runs.error_estimate import REFINEMENTS, Level, companion_step_s, companions, richardson, without_bars
from vfcore.runs.result import Provenance, SimulationResult
from vfcore.runs.setup import GlottisSetup, mean_posture, prepare
from vfcore.spec.simulation import Simulation
from vfcore.version import CODE_VERSION, MODEL_VERSION

PHASES = 100  # of the stored cycle
UNREPEATED_S = 0.010  # what the cycle arrays hold when nothing repeats
Progress = Callable[[float], None]
Stop = Callable[[], bool]


def simulate(
    request: Simulation,
    progress: Progress | None = None,
    stop: Stop | None = None,
    prepared_by: Callable[[Simulation], GlottisSetup] = prepare,
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
    request: Simulation, progress: Progress | None, stop: Stop | None, setup: GlottisSetup, step_s: float | None = None
) -> SimulationResult:
    """One run, with the time step ``step_s`` or the request's own."""
    glottis = setup.glottis
    began = time.perf_counter()
    march, record = _marched(request, setup, [step_s] if step_s else steps_to_try(request.run, glottis), progress, stop)
    kernel_seconds = time.perf_counter() - began
    sample_s, samples = march.time_step_s * march.record_every, len(record)

    arrays = waveforms(record, sample_s, march.form)
    sound = whole_sound(request, arrays["glottal_flow_m3_s"], sample_s)
    arrays |= {"radiated_pressure_pa": sound.lip_pressure_pa, "far_pressure_pa": sound.far_pressure_pa}
    report = measure_all(signals_of(request, setup.postures, glottis, arrays, sample_s), radiate=lambda: sound)
    first, last, complete = _cycle_bounds(report, march, samples, sample_s)
    walls = glottis.walls
    shapes: dict[str, Sequence[np.ndarray] | np.ndarray] = {
        "x_m": [wall.x_m for wall in walls],
        "y_m": [wall.y_m for wall in walls],
        "medial_plane_m": [wall.medial_plane_m.T for wall in walls],
        "static_w_m": [shape.w_m.T for shape in setup.statics],
        "static_wb_m": [shape.w_b for shape in setup.statics],
    }
    cycle = march.cycle(first, last, PHASES)
    shapes |= {name: cycle.pop(name) for name in ("cycle_w_m", "cycle_wb_m")}
    edges = [(wall.medial_plane_m.T - w).min(axis=-1) for wall, w in zip(walls, shapes["cycle_w_m"], strict=True)]
    arrays |= {name: array[0] if len(walls) == 1 else np.array(array) for name, array in shapes.items()}
    arrays |= cycle | {"cycle_edges_m": np.array([edges[0], -edges[-1]])}
    return SimulationResult(
        request=request,
        postures=setup.postures,
        wall_coefficients=tuple(wall.coefficients for wall in walls),
        statics=setup.statics,
        report=report,
        arrays=arrays,
        cycle_is_complete=complete,
        provenance=_provenance(march, sample_s, kernel_seconds),
    )


def _marched(
    request: Simulation, setup: GlottisSetup, steps_s: Sequence[float], progress: Progress | None, stop: Stop | None
) -> tuple[TimeMarch, np.ndarray]:
    """The march at the first of ``steps_s`` at which it does not diverge, and its record."""
    run = request.run
    for step_s in steps_s:
        airways = airways_of(request, step_s)
        march = TimeMarch(setup.glottis, step_s, request.subglottal_pressure_pa, run.pressure_rise_s, airways)
        march.start(0, setup.statics if run.start == "static" else None)
        samples = round(run.duration_s / (march.time_step_s * march.record_every))
        try:
            return march, march.run(samples, progress, stop)
        except DivergenceError:
            if step_s == steps_s[-1]:
                raise
    raise AssertionError("no step to try")


def steps_of(own_s: float, glottises: Sequence[Glottis]) -> list[float]:
    """Time steps in force, s, of a run, ``own_s``, and of its companions, if any, on their grids."""
    finer = zip(REFINEMENTS, glottises[1:], strict=False)
    return [own_s, *(companion_step_s(own_s, by, longest_stable_step_s(glottis)) for by, glottis in finer)]


def _run_with_companions(
    request: Simulation, progress: Progress | None, stop: Stop | None, prepared_by: Callable[[Simulation], GlottisSetup]
) -> SimulationResult:
    """The run itself and its companions; progress is shared in proportion to their work."""
    requests = (request, *companions(request))
    setups = [prepared_by(one) for one in requests]
    glottises = [setup.glottis for setup in setups]
    steps = steps_of(time_step_s(request.run, glottises[0]), glottises)
    work = np.cumsum([0.0] + [one.run.nx * one.run.ny / step for one, step in zip(requests, steps, strict=True)])
    work /= work[-1]

    def run(k: int, step_s: float | None) -> SimulationResult:
        shared = progress and (lambda part: progress(work[k] + part * (work[k + 1] - work[k])))
        return _run(requests[k], shared, stop, setups[k], step_s)

    result = run(0, None)
    steps = steps_of(result.provenance.time_step_s, glottises)  # a march that diverged has taken a shorter one
    levels, reports = [_level(request, steps[0], result)], [result.report]
    for k, one in enumerate(requests[1:], start=1):
        try:
            found = run(k, steps[k])
        except DivergenceError:
            reason = f"The companion on {one.run.nx} × {one.run.ny} nodes diverges."
            return replace(result, error_estimate=without_bars(levels, reason))
        reports.append(found.report)
        levels.append(_level(one, steps[k], found))
    return replace(result, error_estimate=richardson(levels, reports))


def _level(request: Simulation, step_s: float, result: SimulationResult) -> Level:
    return Level(request.run.nx, request.run.ny, step_s, result.report.state)


def waveforms(record: np.ndarray, sample_s: float, form: StepForm) -> dict[str, np.ndarray]:
    """The waveforms by name, (samples,) each, float64, of a record of the first columns of the form: all but the
    sound. ``contact_location`` is x/L of the largest contact pressure, NaN without contact.
    """
    waves = {"time_s": np.arange(len(record)) * sample_s}
    for name, column in zip(form.record, record.T, strict=False):
        wave = np.ascontiguousarray(column, np.float64)
        if name == "contact_column":
            waves["contact_location"] = wave / (form.nx - 1)
        else:
            waves[name] = wave
    return waves


def signals_of(
    request: Simulation,
    postures: Sequence[PostureSolution],
    glottis: Glottis,
    arrays: dict[str, np.ndarray],
    sample_s: float,
    measured_from: int | None = None,
) -> Signals:
    """The signals of a run for its measures: its ``waveforms`` and numbers, without the sound."""
    posture = mean_posture(postures)
    areas = [wall.coefficients.length_m * wall.coefficients.thickness_m for wall in glottis.walls]
    lengths = [wall.coefficients.length_m for wall in glottis.walls]
    angles = [one.glottal_half_angle_rad for one in postures]
    openings = [length * np.tan(angle) for length, angle in zip(lengths, angles, strict=True)]
    return Signals(
        sample_rate_hz=1.0 / sample_s,
        glottal_area_m2=arrays["glottal_area_m2"],
        glottal_flow_m3_s=arrays["glottal_flow_m3_s"],
        contact_pressure_max_pa=arrays["contact_pressure_max_pa"],
        contact_location=arrays["contact_location"],
        contact_area_m2=arrays["contact_area_m2"],
        subglottal_pressure_pa=request.subglottal_pressure_pa,
        length_m=sum(lengths) / len(lengths),
        strain=posture.strain,
        glottal_half_angle_rad=posture.glottal_half_angle_rad,
        gap_m=openings[0] + openings[-1],
        medial_area_m2=sum(areas) / len(areas),
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
