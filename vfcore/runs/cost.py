"""The work of a run, known before it starts: in node-steps of one wall with constant tension and one-way coupling.

The factors are measured (the quickest of 60 rounds of 1000 steps, 20 × 10 nodes, one core). The airways of a coupled
run take the same time for any grid, so they count as so many nodes more.
"""

from vfcore.spec.sides import folds_of
from vfcore.spec.simulation import Run, Simulation

TWO_WALLS = 1.6
FINITE_STRETCH = 1.25
PATCHES = 1.3
ROTATION = 1.5
AIRWAY_NODES = 380


def walls_of(request: Simulation) -> int:
    """Walls that a run of the request marches."""
    return len(folds_of(request))


def node_steps(request: Simulation, run: Run, step_s: float, walls: int, patched: bool) -> float:
    """Work of ``request`` with another ``run``, a time step of ``step_s``, so many walls, with or without patches."""
    model = request.model
    nodes = float(run.nx * run.ny)
    for holds, factor in (
        (walls == 2, TWO_WALLS),
        (model.stretch == "finite", FINITE_STRETCH),
        (patched, PATCHES),
        (model.shear == "rotation", ROTATION),
    ):
        nodes *= factor if holds else 1.0
    if model.coupling == "two_way":
        nodes += AIRWAY_NODES
    return nodes * run.duration_s / step_s
