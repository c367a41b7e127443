"""The composite beam on nx nodes: tension, bending and both end moments as one matrix.

    ρ_l ẅ_b = Ñ_b ∂_xx w_b − μ̃_c ∂_xxxx w_b + …,   w_b(0) = w_b(L) = 0          [eq. BeamEqn]

    x = 0:  μ̃_c w_b'' + M̄_c = −K_r,a (θ_G − λ^{3/2} w_b' − θ_0)                [eq. AnteriorMomentBC]
    x = L:  μ̃_c w_b'' + M̄_c = −K_r,p λ^{3/2} w_b'                              [eq. PosteriorMomentBeamBC]

One ghost node beyond each end, with central differences for slope and curvature at the end, turns a moment condition
into ghost = gain · (first inner node) + offset. The gain enters the matrix; the offset is a constant load. Second order
in dx. The matrix is symmetric. The step treats it implicitly (fold/step.py), so it sets no limit to the time step.
Stored energy ½ (Ñ_b w_b'² + μ̃_c w_b''²) along the beam and that of the end springs: −½ w_bᵀ A w_b dx. Not validated on
its own.
"""

import numpy as np

from vfcore.kernels.jit import formula, jit

#: What ``beam_bands`` returns, in its order.
BANDS = ("at_0", "centre", "at_L", "first", "second", "load_0", "load_L")


@formula
def beam_ends(dx, mu, lam, M_c, K_r_a, K_r_p, theta_g, theta_0):
    """Gain (1) and offset (m) of ghost node = gain · (first inner node) + offset, at x = 0, then at x = L."""
    turn = lam**1.5
    anterior, posterior = K_r_a * turn / (2 * dx), K_r_p * turn / (2 * dx)
    bend = mu / dx**2
    return (
        -(bend - anterior) / (bend + anterior), (-K_r_a * (theta_g - theta_0) - M_c) / (bend + anterior),
        -(bend - posterior) / (bend + posterior), -M_c / (bend + posterior),
    )  # fmt: skip


@formula
def beam_bands(dx, N_b, mu, ends):
    """Force per length of the beam on the inner nodes (two or more), as bands of a symmetric matrix and a load.

    Matrix of w_b, N/m²: the diagonal at the first node, at inner nodes and at the last node; the first and the second
    off-diagonal. Load, N/m: at the first and at the last node. ``ends``: the result of ``beam_ends``.
    """
    gain_0, offset_0, gain_L, offset_L = ends
    pull, bend = N_b / dx**2, mu / dx**4
    return (
        -2.0 * pull - bend * (6.0 + gain_0), -2.0 * pull - 6.0 * bend, -2.0 * pull - bend * (6.0 + gain_L),
        pull + 4.0 * bend, -bend, -bend * offset_0, -bend * offset_L,
    )  # fmt: skip


@jit
def static(band, rhs, bands, pull, scale, at, block):
    """Add the beam of a wall to the static matrix and right side, as vfcore/fold/equilibrium.py stores them.

    ``bands`` (7,), BANDS; ``pull``: tension beyond the prestrain over dx², N/m²; ``scale``: factor of the wall's
    equations; ``at``: place of the beam in a column of ``block`` unknowns.
    """
    n = rhs.shape[0]
    for i in range(n):
        own = bands[1]
        if i == 0:
            own = bands[0]
        elif i == n - 1:
            own = bands[2]
        k = i * block + at
        band[k, 0] -= scale * (own - 2.0 * pull)
        if i < n - 1:
            band[k, block] -= scale * (bands[3] + pull)
        if i < n - 2:
            band[k, 2 * block] -= scale * bands[4]
    rhs[0, at] += scale * bands[5]
    rhs[n - 1, at] += scale * bands[6]


def energy(w_b: np.ndarray, matrix: np.ndarray, load: np.ndarray, dx: float) -> float:
    """Stored by tension, bending and end springs of a wall's beam, less the work of the end moments, J; ``w_b`` (nx,).

    ``matrix`` (nx−2, nx−2), N/m², and ``load`` (nx−2,), N/m: force per length is matrix · w_b + load.
    """
    inner = w_b[1:-1]
    return -dx * float(0.5 * inner @ matrix @ inner + load @ inner)
