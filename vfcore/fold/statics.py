"""The static shape: the equilibrium of a glottis without lung pressure, with contact.

Equations, symmetric form and search for the contact set: vfcore/fold/equilibrium.py. With finite stretch the tensions
follow the shape: they are found by iteration, each time a part of the way to those of the last shape; the part shrinks
where the change grows. The iteration ends when no tension changes by more than TENSION_TOLERANCE of its value.
"""

from dataclasses import dataclass

import numpy as np

from vfcore.errors import StaticShapeError
from vfcore.fold.assemble import Glottis
from vfcore.fold.closure import ClosureShape, describe_closure
from vfcore.fold.equilibrium import NO_SOLUTION, equilibrium_with_contact
from vfcore.fold.terms import of_term, tension

MAX_ITERATIONS = 60
TENSION_TOLERANCE = 1e-11
MAX_STRETCHES = 400


@dataclass(frozen=True, slots=True, eq=False)
class StaticShape:
    """Displacements of one wall at equilibrium in the fold frame, m; w > 0 is medial.

    ``w_m`` (ny, nx) membrane, ``w_b`` (nx,) beam, ends included; ``medial_m`` G (ny, nx). ``closure`` is that of the
    glottis.
    """

    x_m: np.ndarray
    y_m: np.ndarray
    w_m: np.ndarray
    w_b: np.ndarray
    medial_m: np.ndarray
    closure: ClosureShape
    iterations: int


def static_shapes_of(glottis: Glottis) -> tuple[StaticShape, ...]:
    """The equilibrium of ``glottis`` at P_s = 0, for each of its walls.

    Raises StaticShapeError if the contact set or the tensions do not settle.
    """
    walls, (first, *_) = glottis.walls, glottis.walls
    solver = _Solver(glottis)
    T = np.array([np.full(wall.ny, wall.number("T_over_dx2")) for wall in walls])
    pull = np.zeros(len(walls))
    iterations = solver.solve(T, pull)
    if first.finite:
        iterations = _stretched(solver, T, pull, iterations)
    return _shapes(glottis, solver, iterations)


class _Solver:
    """The solve at given tensions, and its scratch arrays."""

    def __init__(self, glottis: Glottis):
        self.walls = walls = glottis.walls
        count, ny, n = len(walls), glottis.ny, glottis.nx - 2
        block = count * (ny + 1)
        self.dy = np.array([wall.dy for wall in walls])
        self.K_foun = np.array([wall.constants.K_foun_pa for wall in walls])
        self.fields = np.array([wall.fields for wall in walls])
        self.bands = np.array([wall.bands for wall in walls])
        self.contact = np.ascontiguousarray(glottis.contact[0])
        self.sheared = not walls[0].rotation  # φ = ∂_y w: no static shear
        self.free = np.empty((n * block, 2 * block + 1))
        self.band, self.rhs, self.x = np.empty_like(self.free), np.empty((n, block)), np.empty((n, block))
        self.cell, self.touching = np.empty(ny), np.empty((ny, n), dtype=np.bool_)

    def solve(self, T: np.ndarray, pull: np.ndarray) -> int:
        """Solve at ``T`` (walls, ny) and ``pull`` (walls,), over dx²; the number of solves."""
        iterations = equilibrium_with_contact(
            T, pull, self.sheared, self.dy, self.K_foun, self.fields, self.bands, self.contact, MAX_ITERATIONS,
            self.free, self.rhs, self.band, self.cell, self.touching, self.x,
        )  # fmt: skip
        if iterations < 0:
            _refuse(iterations == NO_SOLUTION)
        return iterations

    def displacements(self, side: int) -> tuple[np.ndarray, np.ndarray]:
        """w (ny, nx) and w_b (nx,) of a wall, ends included."""
        wall = self.walls[side]
        w, w_b = np.zeros((wall.ny, wall.nx)), np.zeros(wall.nx)
        w[:, 1:-1] = self.x[:, side * wall.ny : (side + 1) * wall.ny].T
        w_b[1:-1] = self.x[:, len(self.walls) * wall.ny + side]
        return w, w_b


def _stretched(solver: _Solver, T: np.ndarray, pull: np.ndarray, iterations: int) -> int:
    """Iterate tensions ``T`` and ``pull``, in place, until they are those of the shape; the number of solves."""
    found, found_pull = np.empty_like(T), np.empty_like(pull)
    scale = np.array([wall.coefficients.beam_tension_n / wall.dx**2 for wall in solver.walls])
    part, last = 1.0, np.inf
    for _ in range(MAX_STRETCHES):
        for side, wall in enumerate(solver.walls):
            w, w_b = solver.displacements(side)
            found_pull[side] = tension.tensions(
                w, w_b, wall.field("tension_share"), of_term(wall.numbers, tension), found[side]
            )
        change = max(float(np.abs(found / T - 1.0).max()), float(np.abs((found_pull - pull) / scale).max()))
        if change <= TENSION_TOLERANCE:
            return iterations
        if change > 0.7 * last:
            part = max(0.5 * part, 1.0 / 64.0)
        last = change
        T += part * (found - T)
        pull += part * (found_pull - pull)
        iterations += solver.solve(T, pull)
    _refuse(False)
    return iterations


def _refuse(unsolvable: bool) -> None:
    what = "has no solution" if unsolvable else "did not settle"
    raise StaticShapeError(f"the static contact {what}; try another posture, a softer K_col_pa_m or a coarser grid")


def _shapes(glottis: Glottis, solver: _Solver, iterations: int) -> tuple[StaticShape, ...]:
    shapes = [solver.displacements(side) for side in range(len(glottis.walls))]
    halves = [wall.medial_plane_m - w for wall, (w, _) in zip(glottis.walls, shapes, strict=True)]
    gap = np.maximum(2.0 * sum(halves) / len(halves), 0.0).min(axis=0)
    closure = describe_closure(gap, np.mean([wall.x_m for wall in glottis.walls], axis=0))
    return tuple(
        StaticShape(wall.x_m, wall.y_m, w, w_b, wall.medial_plane_m, closure, iterations)
        for wall, (w, w_b) in zip(glottis.walls, shapes, strict=True)
    )
