"""Coupling of membrane and beam (paper, eq. MembraneEqn), and the foundation of the beam (eq. BeamEqn).

    traction    K_coup(y)(w_m − w_b) + C_coup(ẇ_m − ẇ_b)        Pa, pulls the membrane towards the beam
    on the beam ∫_0^b traction dy − K_foun w_b − C_foun ẇ_b     N/m; trapezoid rule over the rows

Node by node: no stencil. w in m, ẇ in m/s, K_coup in Pa/m, C_coup in Pa·s/m; floats or SIMD vectors. The explicit step
limits K_coup and C_coup over the reduced mass of both, 1/ρ_s + b/ρ_l, and K_foun and C_foun over ρ_l. Static: the same
forces without velocities. Stored energy per area ½ K_coup (w_m − w_b)², loss
C_coup (ẇ_m − ẇ_b)². Not validated on its own.
"""

import numpy as np

from vfcore.kernels.jit import formula, jit

NUMBERS = ("C_coup", "K_foun", "C_foun")


@jit
def coupling(w_m, v_m, w_b, beam_damper, K_coup, C_coup):
    """Traction between membrane and beam, Pa; it pulls the membrane towards the beam. ``beam_damper``: C_coup ẇ_b."""
    return K_coup * (w_m - w_b) + (C_coup * v_m - beam_damper)


@formula
def coupling_stiffness(from_stiff_edge, c):
    """K_coup, Pa/m, at a fraction 0 to 1 of the thickness from the stiffer edge."""
    return c.K_coup_max_pa_m + (c.K_coup_min_pa_m - c.K_coup_max_pa_m) * from_stiff_edge


@formula
def numbers(c):
    """The values of NUMBERS."""
    return c.C_coup_pa_s_m, c.K_foun_pa, c.C_foun_pa_s


@jit
def bound(largest_K, largest_C, inv_rho_s, inv_rho_l, thickness):
    """ω², 1/s², and rate, 1/s, of the coupling of membrane and beam."""
    inv_reduced_mass = inv_rho_s + thickness * inv_rho_l
    return largest_K * inv_reduced_mass, largest_C * inv_reduced_mass


@jit
def static(band, K, K_foun, cell, at, beam, block):
    """Add coupling and foundation of a wall to the static matrix, as vfcore/fold/equilibrium.py stores it.

    ``K`` (ny, nx); ``cell`` (ny,): heights m_j; ``at`` and ``beam``: places of the wall's first row and of its beam in
    a column of ``block`` unknowns.
    """
    ny, nx = K.shape
    for i in range(nx - 2):
        column = i * block
        band[column + beam, 0] += K_foun
        for j in range(ny):
            spring = cell[j] * K[j, i + 1]
            band[column + at + j, 0] += spring
            band[column + at + j, beam - at - j] -= spring
            band[column + beam, 0] += spring


def energy(w: np.ndarray, w_b: np.ndarray, K: np.ndarray, K_foun: float, cell: np.ndarray, dx: float):
    """Stored by the coupling and by the foundation of a wall, J; ``w`` and ``K`` (ny, nx), ``w_b`` (nx,).

    With dampers and velocities in place of stiffness and displacements: half of the loss, W.
    """
    inner = slice(1, -1)
    stretch = (w - w_b)[:, inner]
    coupled = 0.5 * dx * float((cell[:, None] * K[:, inner] * stretch**2).sum())
    return coupled, 0.5 * dx * K_foun * float((w_b[inner] ** 2).sum())
