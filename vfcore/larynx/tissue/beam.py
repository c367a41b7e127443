"""The composite beam on nx nodes: tension, bending and both end moments as one matrix.

    ρ_l ẅ_b = Ñ_b ∂_xx w_b − μ̃_c ∂_xxxx w_b + …,   w_b(0) = w_b(L) = 0          [eq. BeamEqn]

    x = 0:  μ̃_c w_b'' + M̄_c = −K_r,a (θ_G − λ^{3/2} w_b' − θ_0)                [eq. AnteriorMomentBC]
    x = L:  μ̃_c w_b'' + M̄_c = −K_r,p λ^{3/2} w_b'                              [eq. PosteriorMomentBeamBC]

One ghost node beyond each end, with central differences for slope and curvature at the end, turns a moment condition
into ghost = gain · (first inner node) + offset. The gain enters the matrix; the offset is a constant load. Second order
in dx. The matrix is symmetric. Code of the bands: vfcore/kernels/tissue.py.
"""

import numpy as np

from vfcore.kernels.tissue import beam_bands, beam_ends
from vfcore.larynx.tissue.coefficients import Coefficients
from vfcore.spec.fold_constants import FoldConstants


def beam_operator(
    nx: int, c: Coefficients, constants: FoldConstants, theta_g: float, theta_0: float
) -> tuple[np.ndarray, np.ndarray]:
    """Force per length on the inner nodes: ``matrix @ w_b + load``, N/m.

    ``matrix`` (nx−2, nx−2), N/m²; ``load`` (nx−2,), N/m. ``theta_g`` is the clipped half-angle.
    """
    n = nx - 2
    dx = c.length_m / (nx - 1)
    mu = c.bending_stiffness_n_m2
    ends = beam_ends(
        dx, mu, c.stretch_ratio, c.prestress_moment_n_m, constants.K_r_a_n_m, constants.K_r_p_n_m, theta_g, theta_0
    )
    at_0, centre, at_L, first, second, load_0, load_L = beam_bands(dx, c.beam_tension_n, mu, ends)
    matrix = _banded(n, centre, first, second)
    matrix[0, 0], matrix[-1, -1] = at_0, at_L
    load = np.zeros(n)
    load[0] = load_0
    load[-1] += load_L
    return matrix, load


def _banded(n: int, centre: float, first: float, second: float) -> np.ndarray:
    """Symmetric (n, n) with constant diagonals."""
    matrix = np.zeros((n, n))
    flat = matrix.ravel()
    for shift, value in enumerate((centre, first, second)):
        flat[shift : (n - shift) * n : n + 1] = value  # above the diagonal
        flat[shift * n :: n + 1] = value  # below
    return matrix
