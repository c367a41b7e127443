"""Voices that nobody asked for: whoever computes them has compiled, or loaded, what the next ones need."""

from dataclasses import replace

from vfcore.runs.many import PRECISIONS, run_points
from vfcore.spec.simulation import Model, Run, Simulation

#: Long enough to be judged, for every state needs measures of its own.
PERIODIC = Simulation(run=Run(duration_s=0.3))
IRREGULAR = replace(PERIODIC, activation=replace(PERIODIC.activation, ct=0.0, ta=0.8))
COUPLED = Simulation(model=Model(coupling="two_way"), run=Run(duration_s=0.02))


def warm_up_points() -> None:
    """Many side by side, in both precisions."""
    for precision in PRECISIONS:
        list(run_points([PERIODIC, IRREGULAR], precision=precision))
