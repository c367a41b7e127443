"""Warm-up requests: together they use every kernel of single runs and sweeps."""

from collections.abc import Sequence
from dataclasses import replace

from vfcore.runs.gesture.forms import form_of
from vfcore.runs.many import PRECISIONS, run_points
from vfcore.spec.request import patched, resolve
from vfcore.spec.simulation import Model, Run, Simulation

#: Long enough for a phonation state: each state needs measures of its own.
PERIODIC = Simulation(run=Run(duration_s=0.3))
IRREGULAR = replace(PERIODIC, activation=replace(PERIODIC.activation, ct=0.0, ta=0.8))
COUPLED = Simulation(model=Model(coupling="two_way"), run=Run(duration_s=0.02))
HUMAN = Simulation(model=Model("human"), run=Run(duration_s=0.1))
_PALSY = {"right.activation.ta": 0.1}
#: One request for each further form of the step that users meet first.
FORMS_AHEAD = (
    HUMAN,
    patched(Simulation(), _PALSY),
    patched(HUMAN, _PALSY),
    *(resolve({"lesions": [{"kind": "polyp", "side": side}]}) for side in ("left", "both")),
)
#: The forms in which a map of the human variant is marched.
OF_MAPS = tuple(replace(form_of(HUMAN), many=True, precision=precision) for precision in PRECISIONS)


def warm_up_points(points: Sequence[Simulation] = (PERIODIC, IRREGULAR)) -> None:
    """Compile or load the kernels of sweeps, in both precisions."""
    for precision in PRECISIONS:
        list(run_points(points, precision=precision))
