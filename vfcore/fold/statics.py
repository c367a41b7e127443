"""The static shape: the equilibrium of a fold without lung pressure, with contact.

Equations, symmetric form and search for the contact set: vfcore/kernels/static.py.
"""

from dataclasses import dataclass

import numpy as np

from vfcore.errors import StaticShapeError
from vfcore.fold.assemble import Fold
from vfcore.fold.closure import ClosureShape, describe_closure
from vfcore.kernels.static import NO_SOLUTION, equilibrium_with_contact

MAX_ITERATIONS = 60


@dataclass(frozen=True, slots=True, eq=False)
class StaticShape:
    """Displacements at equilibrium in the fold frame, m; w > 0 is medial.

    ``w_m`` (ny, nx) membrane, ``w_b`` (nx,) beam, ends included; ``medial_m`` G (ny, nx).
    """

    x_m: np.ndarray
    y_m: np.ndarray
    w_m: np.ndarray
    w_b: np.ndarray
    medial_m: np.ndarray
    closure: ClosureShape
    iterations: int


def static_shape_of(fold: Fold) -> StaticShape:
    """Solve for the equilibrium of ``fold`` at P_s = 0.

    Raises StaticShapeError if the contact set does not settle.
    """
    ny, n, block = fold.ny, fold.nx - 2, fold.ny + 1
    c, k = fold.coefficients, fold.constants
    free = np.empty((n * block, 2 * block + 1))
    solution = np.empty((n, block))
    iterations = equilibrium_with_contact(
        c.membrane_tension_n_m / fold.dx**2,
        0.0 if fold.rotation else c.membrane_shear_n_m / fold.dy**2,  # φ = ∂_y w: no static shear
        fold.dy,
        fold.K_coup_pa_m,
        k.K_foun_pa,
        k.K_col_pa_m,
        fold.beam_matrix_n_m2,
        fold.beam_load_n_m,
        np.ascontiguousarray(fold.medial_plane_m[:, 1:-1]),
        MAX_ITERATIONS,
        free,
        np.empty_like(free),
        np.empty((ny, n), dtype=np.bool_),
        solution,
    )
    if iterations < 0:
        what = "has no solution" if iterations == NO_SOLUTION else f"did not settle after {MAX_ITERATIONS} solves"
        raise StaticShapeError(f"the static contact {what}; try another posture, a softer K_col_pa_m or a coarser grid")
    return _shape(fold, solution, iterations)


def _shape(fold: Fold, solution: np.ndarray, iterations: int) -> StaticShape:
    w_m = np.zeros((fold.ny, fold.nx))
    w_m[:, 1:-1] = solution[:, : fold.ny].T
    w_b = np.zeros(fold.nx)
    w_b[1:-1] = solution[:, fold.ny]
    gap = 2.0 * np.maximum(fold.medial_plane_m - w_m, 0.0).min(axis=0)
    return StaticShape(
        x_m=fold.x_m,
        y_m=fold.y_m,
        w_m=w_m,
        w_b=w_b,
        medial_m=fold.medial_plane_m,
        closure=describe_closure(gap, fold.x_m),
        iterations=iterations,
    )
