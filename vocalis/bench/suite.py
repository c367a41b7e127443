"""All benchmarks of the modal case on the default grid, as rows of one table."""

import os
import platform
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from statistics import median
from typing import NamedTuple

import numpy as np

from vfcore.fold.form import LANES, StepForm
from vfcore.fold.layout import layout_of
from vfcore.fold.march import TimeMarch
from vfcore.fold.march_many import MarchInput, march_many
from vfcore.fold.statics import static_shapes_of
from vfcore.io.netcdf import write_netcdf
from vfcore.larynx.posture.equilibrium import solve_posture, solve_posture_batch
from vfcore.runs.one import simulate
from vfcore.runs.setup import prepare
from vfcore.spec.simulation import DEFAULT_STEP_S, PAPER_STEP_S, Simulation
from vocalis.bench import compare, forms, machine, processes, reference
from vocalis.bench.answers import POINTS, answers
from vocalis.bench.count import count_step
from vocalis.bench.forms import FORMS
from vocalis.bench.interactive import SECOND_MS
from vocalis.bench.played import share_of_a_core
from vocalis.bench.rounds import turns

BATCH = 1000
STORED_TARGET_S = 0.08  # request to stored result of 1 s of voice
KERNEL_TARGET_S = 0.012  # 1 s of voice on one core
PAPER_STEP_TARGET_S = 0.2
PAPER_MINUTE_S = 60.0  # the paper: "under a minute" for a simulation of 1 s
BATCH_VOICE_S = 1.0
MAP_TARGETS_S = {"map": 3.0, "map_single": 1.5}  # 441 runs of 1 s on two cores
STATIC_BATCH_TARGET_S = 1.0
#: At least: plain loop over kernel, and kernel over each voice of a batch.
REFERENCE_TARGET, GAINS = 20.0, {"batch": 1.25, "single_precision": 2.0}
#: At most: the time of a form of the step over that of linear tension, one fold and its mirror image; alone, and in
#: batches of both precisions.
OVER_LINEAR = {"finite": 1.15, "two": 2.1, "two_finite": None}
HUMAN_OVER_PAPER = 2.2  # a map of the variant human over the paper's
LIVE_TARGET = 12.0  # % of a core: two walls, finite stretch, a muscle moved before every block
LIVE_SECONDS_A_ROUND = 2


class Row(NamedTuple):
    """One number of the table.

    ``value``: from the median of all rounds. ``quickest``: from the quickest turn of each task, that is, without
    contention. ``target``: upper limit in the same unit. ``at_least``: lower limit.
    """

    key: str
    label: str
    value: float
    unit: str
    target: float | None = None
    quickest: float | None = None
    at_least: float | None = None


def run(rounds: int, fresh_processes: bool = True, progress: Callable[[str], None] = lambda what: None) -> list[Row]:
    """All rows. ``progress`` is called with the name of each part.

    ``fresh_processes``: also what needs new processes: memory, start-up, operation counts and answers of a server.
    """
    progress(f"timing, {rounds} rounds")
    with tempfile.TemporaryDirectory() as folder:
        seconds = turns(_tasks(Path(folder) / "result.nc"), rounds)
    rows = _with_quickest(_timings, seconds)
    progress("forms of the step")
    core = {"peak": machine.peak_task()[0], "l1": machine.cache_task()[0]}
    core_seconds = turns(core, rounds, clock=time.thread_time)
    per_step = forms.step_seconds(rounds)
    rows += _with_quickest(_core, core_seconds) + _with_quickest(_ratios, per_step)
    progress("a played voice")
    rows += _with_quickest(_played, {"live": share_of_a_core(rounds * LIVE_SECONDS_A_ROUND)})
    if fresh_processes:
        progress("answers of a server")
        rows += _with_quickest(_answers, seconds | answers(rounds))
        progress("memory of a run")
        rows += _memory()
        progress("compiling from nothing")
        rows += _start_up()
        progress("counting operations")
        grid = Simulation().run
        counted = {form.options: count_step(grid.nx, grid.ny, *form.options) for form in FORMS.values()}
        rows += _with_quickest(lambda took: _efficiency(took, counted), core_seconds | per_step)
    return rows


def machine_description() -> dict[str, str | int | None]:
    """The machine on which the numbers were measured."""
    return {
        "machine": platform.machine(),
        "processor": _processor(),
        "cores": os.cpu_count(),
        "system": platform.platform(),
        "python": platform.python_version(),
    }


def _tasks(stored: Path) -> dict[str, Callable[[], object]]:
    request = Simulation()
    setup = prepare(request)
    glottis, fold = setup.glottis, setup.fold
    activations = np.random.default_rng(1).random((BATCH, 5))

    def kernel(step_s: float) -> Callable[[], object]:
        def march():
            moving = TimeMarch(glottis, step_s, request.subglottal_pressure_pa)
            moving.start(0, None)
            return moving.run(round(1.0 / (step_s * moving.record_every)))

        return march

    def batch(precision: str) -> Callable[[], object]:
        inputs = [MarchInput(glottis, DEFAULT_STEP_S, request.subglottal_pressure_pa, BATCH_VOICE_S)] * LANES[precision]
        return lambda: list(march_many(inputs, single_precision=precision == "float32"))

    return {
        "posture": lambda: solve_posture(request.activation, request.posturing),
        "postures": lambda: solve_posture_batch(activations, request.posturing),
        "static": lambda: static_shapes_of(glottis),
        "prepare": lambda: prepare(request),
        "kernel": kernel(DEFAULT_STEP_S),
        "kernel_paper_step": kernel(PAPER_STEP_S),
        "reference": lambda: reference.plain_run(fold, request.subglottal_pressure_pa, 1.0),
        "batch": batch("float64"),
        "batch_single": batch("float32"),
        "result": lambda: simulate(request),
        "stored": lambda: write_netcdf(simulate(request), stored),
    } | compare.tasks()


def _with_quickest(rows: Callable[[dict[str, float]], Iterator[Row]], seconds: dict[str, list[float]]) -> list[Row]:
    """Rows from the medians of ``seconds``, each with the number from the quickest turns in ``quickest``."""
    typical, best = (rows({name: of(took) for name, took in seconds.items()}) for of in (median, min))
    return [row._replace(quickest=other.value) for row, other in zip(typical, best, strict=True)]


def _timings(seconds: dict[str, float]) -> Iterator[Row]:
    yield Row("posture_us", "posture: muscles → strain and angle", seconds["posture"] * 1e6, "µs")
    yield Row("posture_batch_us", f"posture, each of a batch of {BATCH}", seconds["postures"] / BATCH * 1e6, "µs")
    yield Row("static_ms", "static shape with contact", seconds["static"] * 1e3, "ms")
    yield Row("prepare_ms", "request → posture and static shape", seconds["prepare"] * 1e3, "ms")
    label = f"kernel, 1 s of voice, step {DEFAULT_STEP_S * 1e6:.2f} µs"
    yield Row("kernel_s", label, seconds["kernel"], "s", KERNEL_TARGET_S)
    label = f"  at the paper's step, {PAPER_STEP_S * 1e6:.4f} µs"
    yield Row("kernel_paper_step_s", label, seconds["kernel_paper_step"], "s", PAPER_STEP_TARGET_S)
    label = f"plain compiled loop, step {reference.STEP_S * 1e6:.2f} µs"
    yield Row("reference_s", label, seconds["reference"], "s")
    ratio = seconds["reference"] / seconds["kernel"]
    yield Row("reference_ratio", "plain loop / kernel", ratio, "×", at_least=REFERENCE_TARGET)
    ratio = seconds["reference"] / seconds["kernel_paper_step"]
    yield Row("paper_step_ratio", "plain loop / kernel at the paper's step", ratio, "×")
    for task, precision, label in (("batch", "float64", "batch"), ("batch_single", "float32", "single_precision")):
        each = seconds[task] / LANES[precision] / BATCH_VOICE_S
        yield Row(f"{label}_s", f"kernel, each of {LANES[precision]} voices in {precision}", each, "s")
        yield Row(
            f"{label}_gain", "  a voice alone / one of them", seconds["kernel"] / each, "×", at_least=GAINS[label]
        )
        yield Row(f"{label}_ratio", "  plain loop / kernel", seconds["reference"] / each, "×")
    static_s = seconds["static"] * BATCH
    yield Row("static_batch_s", f"{BATCH} static shapes, one after the other", static_s, "s", STATIC_BATCH_TARGET_S)
    yield Row("paper_minute_ratio", "the paper's minute / request → result", PAPER_MINUTE_S / seconds["result"], "×")
    yield from (Row(*row) for row in compare.rows(seconds))
    yield Row("result_s", "request → result, 1 s of voice", seconds["result"], "s")
    yield Row("stored_s", "request → stored netCDF, 1 s of voice", seconds["stored"], "s", STORED_TARGET_S)


def _core(seconds: dict[str, float]) -> Iterator[Row]:
    yield Row("peak_gflop_s", "this core: multiply-adds", _peak_gflop_s(seconds), "Gflop/s")
    yield Row("l1_gb_s", "this core: L1 bandwidth", _l1_gb_s(seconds), "GB/s")


def _ratios(seconds: dict[str, float]) -> Iterator[Row]:
    yield Row("step_ns", "one step, linear tension, one fold mirrored", seconds["linear"] * 1e9, "ns")
    labels = {"finite": "finite stretch", "two": "two different folds", "two_finite": "two folds, finite stretch"}
    for batch, where in (("", ""), ("_batch", ", in a batch"), ("_single", ", in a batch in float32")):
        for name, most in OVER_LINEAR.items():
            if name + batch in seconds:
                ratio = seconds[name + batch] / seconds["linear" + batch]
                yield Row(f"{name}{batch}_ratio", f"  {labels[name]} / linear, one fold{where}", ratio, "×", most)


def _played(share: dict[str, float]) -> Iterator[Row]:
    label = "played voice, two folds, finite stretch, moving"
    yield Row("live_share", label, 100 * share["live"], "% of a core", LIVE_TARGET)


def _answers(seconds: dict[str, float]) -> Iterator[Row]:
    yield Row("http_s", "request → whole answer through HTTP, 1 s of voice", seconds["http"], "s", 1e-3 * SECOND_MS)
    runs, cores = POINTS**2, os.cpu_count() or 1
    for name, label in (("map", f"map of {runs} runs of 1 s, request → table"), ("map_single", "  in float32")):
        yield Row(f"{name}_s", label, seconds[name], "s", MAP_TARGETS_S[name])
        plain_s = seconds["reference"] * runs / cores
        yield Row(f"{name}_ratio", f"  plain loop on {cores} cores / map", plain_s / seconds[name], "×")
    for batch, where in (("", ""), ("_single", " in float32")):
        label = f"map of the variant human / paper's map{where}"
        ratio = seconds[f"map_human{batch}"] / seconds[f"map{batch}"]
        yield Row(f"map_human{batch}_ratio", label, ratio, "×", HUMAN_OVER_PAPER)


def _peak_gflop_s(seconds: dict[str, float]) -> float:
    return machine.peak_task()[1] / seconds["peak"] * 1e-9


def _l1_gb_s(seconds: dict[str, float]) -> float:
    return machine.cache_task()[1] / seconds["l1"] * 1e-9


def _memory() -> Iterator[Row]:
    seen = processes.memory()
    if seen is None:
        return
    yield Row("memory_mb", "peak resident memory, simulating 1 s", seen["after_bytes"] * 1e-6, "MB")
    grown = seen["after_bytes"] - seen["before_bytes"]
    yield Row("memory_run_mb", "  of it by that run", grown * 1e-6, "MB")


def _start_up() -> Iterator[Row]:
    cold, warm = processes.first_results()
    yield Row("load_s", "import vfcore", warm["load_s"], "s")
    yield Row("first_cold_s", "first result, kernels compiled", cold["first_result_s"], "s")
    yield Row("first_warm_s", "first result, kernels from the cache", warm["first_result_s"], "s")


def _efficiency(seconds: dict[str, float], counted: dict[tuple[str, ...], dict[str, int]]) -> Iterator[Row]:
    grid, one = Simulation().run, counted[()]
    gb_s = one["accesses"] * 8 / seconds["linear"] * 1e-9
    size = layout_of(StepForm(grid.nx, grid.ny)).size * 8
    yield Row("operations", "operations a step in contact, as written", one["arithmetic"], "flop")
    yield Row("bytes", "bytes moved a step, as written", one["accesses"] * 8, "B")
    yield Row("state_bytes", "the buffer of a glottis", size, "B")
    yield Row("gb_s", "linear step: memory as written", gb_s, "GB/s")
    yield Row("of_l1", "  of this core's L1 bandwidth", 100 * gb_s / _l1_gb_s(seconds), "%")
    for name, form in FORMS.items():
        operations = counted[form.options]["arithmetic"]
        floor_s = operations / (_peak_gflop_s(seconds) * 1e9) / (2 if form.precision == "float32" else 1)
        label = f"{name.replace('_', ', ')}: {operations:,} operations a step, time over multiply-adds alone"
        yield Row(f"{name}_over_floor", label, seconds[name] / floor_s, "×")


def _processor() -> str | None:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor() or None
    return next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), None)
