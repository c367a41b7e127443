"""Where the energy of a glottis is, and where it goes, term by term.

    d/dt (kinetic + stored) = power of the air − loss

For a state of a wall: displacements w (ny, nx) and w_b (nx,), velocities at the same time. Stored energies follow from
the terms' laws (vfcore/fold/terms), so that each force is minus the derivative of its energy on the grid. The rotation
equation is not included. Contact stores in each wall the energy of its half of the penetration; the loss of its damper
may be negative while the folds separate. Verified in tests/physics/test_energy_*.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vfcore.fold.assemble import Fold, Glottis
from vfcore.fold.terms import beam, contact, coupling, of_term, shear, tension


class WallState(NamedTuple):
    """Displacements, m, and velocities, m/s, of a wall: membrane (ny, nx), beam (nx,)."""

    w: np.ndarray
    w_b: np.ndarray
    v: np.ndarray
    v_b: np.ndarray


def cell_heights(fold: Fold) -> np.ndarray:
    """m_j (ny,), m: dy, half of it in an edge row."""
    heights = np.full(fold.ny, fold.dy)
    heights[[0, -1]] *= 0.5
    return heights


def energies(glottis: Glottis, states: Sequence[WallState]) -> dict[str, float]:
    """Energy by term, J, of all walls: of a fold and its mirror image that of the one fold."""
    half = sum(wall.medial_plane_m - state.w for wall, state in zip(glottis.walls, states, strict=True)) / len(states)
    total: dict[str, float] = {}
    for wall, state in zip(glottis.walls, states, strict=True):
        for name, value in _of_wall(wall, state, half, glottis.contact[0]).items():
            total[name] = total.get(name, 0.0) + value
    return total


def _of_wall(wall: Fold, state: WallState, half: np.ndarray, K_col: np.ndarray) -> dict[str, float]:
    cell, dx, numbers = cell_heights(wall), wall.dx, wall.numbers
    w, w_b = state.w, state.w_b
    mass = cell[:, None] * wall.field("mass")
    moving = 0.5 * dx * float((mass * state.v**2)[:, 1:-1].sum())
    beam_moving = 0.5 * dx * wall.coefficients.beam_density_kg_m * float((state.v_b[1:-1] ** 2).sum())
    share = wall.field("tension_share")
    along, axial = tension.energy(w, w_b, share, cell, dx, of_term(numbers, tension), wall.finite)
    coupled, foundation = coupling.energy(w, w_b, wall.field("coupling"), wall.number("K_foun"), cell, dx)
    return {
        "kinetic": moving + beam_moving,
        "tension": along,
        "beam": axial + beam.energy(w_b, wall.beam_matrix_n_m2, wall.beam_load_n_m, dx),
        "shear": shear.energy(w, wall.field("shear"), dx, wall.dy),
        "coupling": coupled,
        "foundation": foundation,
        "contact": contact.energy(half, K_col, cell, dx),
    }


def losses(glottis: Glottis, states: Sequence[WallState]) -> dict[str, float]:
    """Power lost by term, W, of all walls."""
    walls = list(zip(glottis.walls, states, strict=True))
    half = sum(wall.medial_plane_m - state.w for wall, state in walls) / len(states)
    closing = sum(state.v for state in states) / len(states)
    total = {"shear": 0.0, "coupling": 0.0, "foundation": 0.0, "contact": 0.0}
    for wall, state in walls:
        cell, dx = cell_heights(wall), wall.dx
        damper = wall.field("coupling_damper")
        coupled, foundation = coupling.energy(state.v, state.v_b, damper, wall.number("C_foun"), cell, dx)
        touching = (half < 0.0)[:, 1:-1]
        pressed = (cell[:, None] * glottis.contact[1] * closing * state.v)[:, 1:-1]
        total["shear"] += 2.0 * shear.energy(state.v, wall.field("shear_viscosity"), dx, wall.dy)
        total["coupling"] += 2.0 * coupled
        total["foundation"] += 2.0 * foundation
        total["contact"] += dx * float(pressed[touching].sum())
    return total
