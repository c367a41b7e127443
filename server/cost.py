"""What a run will cost, known before it starts: nodes times steps."""

from vfcore.errors import ParameterError
from vfcore.params import DEFAULT_STEP_S, Simulation
from vfcore.simulate import prepare
from vfcore.stability import time_step_s


def check_cost(request: Simulation, limit: float, setting: str) -> None:
    """ParameterError when nx·ny·steps is above ``limit``, which ``setting`` names.

    Finds the posture on the way, as the longest stable step depends on it: raises what ``prepare`` raises.
    """
    run = request.run
    node_seconds = run.nx * run.ny * run.duration_s
    cost = node_seconds / (run.time_step_s or DEFAULT_STEP_S)
    if cost <= limit:  # otherwise the step needs no looking up: it can only be shorter
        cost = node_seconds / time_step_s(run, prepare(request).fold)
    if cost > limit:
        raise ParameterError(
            "run", f"{run.nx}×{run.ny} nodes for {run.duration_s:g} s are {cost:.2g} node-steps",
            f"up to {limit:g} node-steps ({setting}): a shorter run, a coarser grid or a longer step",
        )  # fmt: skip
