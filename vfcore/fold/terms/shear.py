"""Shear of the mucosa across the thickness (paper, eq. MembraneEqn), second-order stencils.

``kelvin_voigt``: ∂_y(G̃ ∂_y w + η̃ ∂_y ẇ); flux on half rows j+½,

    F_{j+½} = (G̃/dy)(w_{j+1} − w_j) + (η̃/dy)(ẇ_{j+1} − ẇ_j)
    shear_j = (F_{j+½} − F_{j−½})/dy        edge rows (no flux through the edge): F beyond the edge is −F within

Where G̃ is uniform F is linear in the rows: each row computes (G̃ w + η̃ ẇ)/dy once, and F_{j+½} is the difference
between rows j+1 and j. Where it varies, G̃ and η̃ have their own value on each half row.

``rotation``: the same with ∂_y w − φ in place of ∂_y w; φ is defined on the half rows and
obeys  J_m φ̈ = G_m(∂_y w − φ) + η_m(∂_y ẇ − φ̇)   [eq. RotationMembrane].

w in m, ẇ in m/s, G̃/dy² in Pa/m; floats or SIMD vectors. Second order in dy. The explicit step limits 4 G̃/dy² and
4 η̃/dy². Static: the same force without velocities; with ``rotation`` none, since φ = ∂_y w. Stored energy per length
and half row ½ (G̃/dy)(w_{j+1} − w_j)², loss (η̃/dy)(ẇ_{j+1} − ẇ_j)². Not validated on its own.
"""

import numpy as np

from vfcore.kernels.jit import formula, jit

#: ``rotation_share``: G_m over G̃_m/dy², the same as η_m over η̃_m/dy²: λ dy²/d_muc.
NUMBERS = (
    "G_shear_over_dy2", "eta_shear_over_dy2", "inv_rotation_inertia", "G_rotation", "eta_rotation", "rotation_share",
)  # fmt: skip


@jit
def kelvin_voigt(w, v, G, eta):
    """G w + η v of one row; the flux between two rows is the difference, less the same of dy φ and dy φ̇ (rotation)."""
    return G * w + eta * v


@formula
def numbers(G_t, eta_t, rho_s, J, lam, dy, c):
    """The values of NUMBERS; G̃_m, η̃_m, ρ_s, J_m and λ of the coefficients. λ/d_muc is λ² ρ_s/(12 J_m)."""
    return G_t / dy**2, eta_t / dy**2, 1.0 / J, c.G_m_pa, c.eta_m_pa_s, lam**2 * rho_s / (12.0 * J) * dy**2


@jit
def bound(rotation, numbers, largest_G, largest_eta):
    """Largest stiffness, Pa/m, and damper, Pa·s/m, of the membrane, and ω² and rate of the rotation, 1/s² and 1/s.

    ``numbers``: NUMBERS; the largest G̃ and η̃ of the surface over dy².
    """
    turning = numbers[5] * numbers[2] if rotation else 0.0
    return 4.0 * largest_G, 4.0 * largest_eta, turning * largest_G, turning * largest_eta


@jit
def static(band, G, dy, at, block):
    """Add the shear of a wall to the static matrix, in its storage; ``G`` (ny, nx) over dy²."""
    ny, nx = G.shape
    for i in range(nx - 2):
        for j in range(ny - 1):
            k, spring = i * block + at + j, dy * G[j, i + 1]
            band[k, 0] += spring
            band[k + 1, 0] += spring
            band[k, 1] -= spring


def energy(w: np.ndarray, G: np.ndarray, dx: float, dy: float) -> float:
    """Stored by a wall, J; ``w`` and ``G`` (G̃ over dy²) (ny, nx). With η̃ over dy² and ẇ: half of the loss, W."""
    return float(0.5 * dx * dy * (G[:-1] * np.diff(w, axis=0) ** 2).sum())
