"""Progress of a run, on standard error if it is a terminal."""

from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

from rich.console import Console
from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

from vfcore.runs.one import simulate
from vfcore.runs.result import SimulationResult
from vfcore.spec.simulation import Run, Simulation

T = TypeVar("T")
#: Long enough to run every kernel once, short enough not to be noticed.
WARM_UP_S = 0.02


def simulate_watched(request: Simulation) -> SimulationResult:
    """``simulate(request)``; on a terminal with the progress of compilation and of the run."""
    console = Console(stderr=True)
    if not console.is_terminal:
        return simulate(request)
    columns = SpinnerColumn(), TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn()
    with Progress(*columns, console=console, transient=True) as bars:
        compiling = bars.add_task("compiling kernels (slow the first time only)", total=None)
        compile_kernels(request)
        bars.remove_task(compiling)
        run = bars.add_task(f"simulating {request.run.duration_s:g} s", total=1.0)
        return simulate(request, progress=lambda fraction: bars.update(run, completed=fraction))


def watched(duration_s: float, work: Callable[[Callable[[float], None] | None], T]) -> T:
    """``work(progress)``; on a terminal with a bar over the simulated time."""
    console = Console(stderr=True)
    if not console.is_terminal:
        return work(None)
    columns = SpinnerColumn(), TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn()
    with Progress(*columns, console=console, transient=True) as bars:
        run = bars.add_task(f"simulating {duration_s:g} s", total=1.0)
        return work(lambda fraction: bars.update(run, completed=fraction))


def compile_kernels(request: Simulation) -> None:
    """Compile, or load from the cache, all kernels that ``request`` needs, by a short run."""
    run: Run = replace(request.run, duration_s=WARM_UP_S, pressure_rise_s=0.0)
    simulate(replace(request, run=run))
