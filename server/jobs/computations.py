"""The calls that the server sends to other processes. Their imports wait until the first call, so that a process
starts at once.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from vfcore.runs.result import SimulationResult
    from vfcore.runs.sweep.plan import Sweep
    from vfcore.runs.sweep.task import TaskResult
    from vocalis.server.jobs.executor_slot import Progress, Stop


def run_simulation(
    request: dict[str, Any], progress: "Progress | None" = None, stop: "Stop | None" = None
) -> "SimulationResult":
    """Run the simulation of a canonical request document; raises what ``vfcore.simulate`` raises."""
    from vfcore.runs.one import simulate
    from vfcore.spec.request import resolve

    return simulate(resolve(request), progress, stop)


def run_part_of_sweep(
    part: "Sweep", model_version: str, progress: "Progress | None" = None, stop: "Stop | None" = None
) -> "TaskResult":
    """Compute the points of a part of a sweep; raises WrongModel and Cancelled. It reports no progress."""
    from vfcore.runs.sweep.task import run_task

    return run_task(part, model_version, stop)


def warm_up(progress: "Progress | None" = None, stop: "Stop | None" = None) -> None:
    """Compile or load the kernels of sweeps in this process."""
    from vocalis.server.warmup.requests import warm_up_points

    warm_up_points()
