"""The static shape: the fold at rest with no lung pressure, by a direct solve with contact.

Setting time derivatives and P_s to zero leaves a linear system with unilateral springs,

    T̃_m ∂_xx w + ∂_y(G̃_m ∂_y w) − K_coup (w − w_b) − K_col (w − G)⁺ = 0
    beam operator · w_b + load − ∫ K_coup (w_b − w) dy − K_foun w_b = 0

(with the rotation equation φ follows ∂_y w and the static shear vanishes). It is piecewise
linear and monotone, so Newton on the set of touching nodes ends after finitely many solves.
Unknowns are ordered by column, (w_0 … w_{ny−1}, w_b) at each inner x: a band of half width
2 (ny + 1), solved by LAPACK.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_banded

from vfcore.assemble import Fold
from vfcore.closure import ClosureShape, describe_closure
from vfcore.errors import StaticShapeError

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

    Raises StaticShapeError when the contact set does not settle.
    """
    ny, n, block = fold.ny, fold.nx - 2, fold.ny + 1
    half = 2 * block
    c, k = fold.coefficients, fold.constants
    T, G_t = c.membrane_tension_n_m / fold.dx**2, c.membrane_shear_n_m / fold.dy**2
    if fold.rotation:
        G_t = 0.0
    weight = np.ones(ny)
    weight[[0, -1]] = 0.5
    K = fold.K_coup_pa_m

    band = np.zeros((2 * half + 1, n * block))

    def diagonal(offset: int) -> np.ndarray:
        """View (n, block) of the entries (row, row + offset), indexed by their column."""
        return band[half - offset].reshape(n, block)

    centre, mem = diagonal(0), np.s_[:, :ny]
    centre[mem] = -2.0 * T - 2.0 * G_t - K
    above, below = diagonal(1), diagonal(-1)  # row j couples to column j + 1, j − 1
    above[:, 1:ny] = G_t
    above[:, 1] = 2.0 * G_t  # superior edge: a half cell, one neighbour
    below[:, : ny - 1] = G_t
    below[:, ny - 2] = 2.0 * G_t  # inferior edge
    for offset in (block, -block):  # neighbours in x
        side = diagonal(offset)
        columns = slice(1, n) if offset > 0 else slice(0, n - 1)
        side[columns, :ny] += T
    for j in range(ny):  # membrane row j ← beam column, and beam row ← membrane column j
        diagonal(ny - j)[:, ny] += K[j]
        diagonal(j - ny)[:, j] += K[j] * weight[j] * fold.dy
    B = fold.beam_matrix_n_m2
    for shift in range(-2, 3):
        side = diagonal(shift * block)
        values = np.diagonal(B, shift)
        columns = np.arange(len(values)) + max(shift, 0)
        side[columns, ny] += values
    centre[:, ny] -= k.K_foun_pa + float((K * weight).sum()) * fold.dy

    G = fold.medial_plane_m[:, 1:-1].T  # (n, ny)
    load = np.zeros((n, block))
    load[:, ny] = -fold.beam_load_n_m
    touching = np.zeros((n, ny), dtype=bool)
    for iteration in range(1, MAX_ITERATIONS + 1):
        matrix, right = band.copy(), load.copy()
        matrix[half].reshape(n, block)[mem] -= k.K_col_pa_m * touching
        right[mem] -= k.K_col_pa_m * touching * G
        solution = solve_banded(
            (half, half), matrix, right.ravel(), overwrite_ab=True, overwrite_b=True, check_finite=False
        ).reshape(n, block)
        now = solution[mem] > G
        if (now == touching).all():
            return _shape(fold, solution, iteration)
        touching = now
    raise StaticShapeError(
        f"the static contact did not settle after {MAX_ITERATIONS} solves; "
        "try another posture, a softer K_col_pa_m or a coarser grid"
    )


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
