"""The cost of a run, known before it starts: nodes times steps, weighted by what a step does, including the finer
runs of an error estimate.
"""

from dataclasses import replace

from vfcore.errors import ParameterError
from vfcore.fold.stability import time_step_s
from vfcore.runs.cost import node_steps, walls_of
from vfcore.runs.error_estimate import companions
from vfcore.runs.one import steps_of
from vfcore.runs.setup import prepare
from vfcore.spec.simulation import Simulation


def check_cost(request: Simulation, limit: float, setting: str) -> None:
    """ParameterError when all runs that ``request`` needs are more than ``limit`` node-steps, which ``setting`` names.

    Solves the posture, because the longest stable step depends on it: raises what ``prepare`` raises.
    """
    run = request.run
    runs = [run, *(one.run for one in companions(request))] if run.error_estimate else [run]
    walls, patched = walls_of(request), bool(request.lesions)
    cost = sum(node_steps(request, one, run.step_s, walls, patched) for one in runs)
    if cost <= limit:  # the steps can only be shorter than this, so a run above the limit needs no posture
        glottises = [prepare(replace(request, run=one)).glottis for one in runs]
        steps = steps_of(time_step_s(run, glottises[0]), glottises)
        cost = sum(node_steps(request, one, step, walls, patched) for one, step in zip(runs, steps, strict=True))
    if cost > limit:
        raise ParameterError(
            "run", f"{run.nx}×{run.ny} nodes{' on each of two folds' if walls == 2 else ''} for {run.duration_s:g} s"
            f"{' and the finer runs of its error estimate' if len(runs) > 1 else ''} are {cost:.2g} node-steps",
            f"up to {limit:g} node-steps ({setting}): a shorter run, a coarser grid or a longer step",
        )  # fmt: skip
