"""The same equations as a plain compiled loop, the reference for the speed and accuracy of the kernel.

The obvious implementation: two-dimensional arrays, node by node, a search for the separation point, semi-implicit Euler
with an explicit beam

    v^{n+1} = v^n + dt a(w^n, v^n),   w^{n+1} = w^n + dt v^{n+1}

at a fifth of the default step (7.14 µs, one section of the tract; the explicit beam is not stable much beyond). Order 1
in dt. Flow, contact and membrane use the laws of vfcore/fold/terms. One fold and its mirror image, linear tension,
Kelvin–Voigt shear, no patches.
"""

from typing import NamedTuple

import numpy as np

from vfcore.fold.assemble import Fold
from vfcore.fold.terms import air, contact, coupling, shear, tension
from vfcore.kernels.jit import jit
from vfcore.spec.simulation import SECTION_TRAVEL_S

STEP_S = SECTION_TRAVEL_S

contact_pressure = contact.contact_pressure
gap, is_open, opening, square = air.gap, air.is_open, air.opening, air.square
separation_gap, half_segment, viscous_drop = air.separation_gap, air.half_segment, air.viscous_drop
flux_root, slice_flux, pressure = air.flux_root, air.slice_flux, air.pressure
along_fold, traction_of, kelvin_voigt = tension.tension, coupling.coupling, shear.kelvin_voigt


class Laws(NamedTuple):
    """Coefficients of one fold, SI; names as in vfcore.fold.terms."""

    dx: float
    dy: float
    P_s: float
    alpha_s: float
    half_rho_a: float
    twelve_mu_a: float
    T_over_dx2: float
    G_shear: float
    eta_shear: float
    C_coup: float
    K_col: float
    C_col: float
    K_foun: float
    C_foun: float
    rho_s: float
    rho_l: float


@jit
def _slice_pressure(w, G, i, k, p, d):
    """Fill ``p`` (ny,) with the aerodynamic pressure of slice ``i``; ``d`` (ny,) is scratch. Returns d_min, q."""
    ny = p.size
    d_min, d_max = np.inf, 0.0
    for j in range(ny):
        d[j] = gap(G[j, i] - w[j, i])
        d_min, d_max = min(d_min, d[j]), max(d_max, d[j])
    d_sep = separation_gap(d_min, d_max, k.alpha_s)
    j_sep = ny - 1
    while d[j_sep] > d_sep:
        j_sep -= 1
    integral = 0.0
    for j in range(ny - 2, j_sep - 1, -1):
        for r in (1.0 / d[j + 1], 1.0 / d[j]):
            integral = half_segment(integral, square(r), r)
    six_mu_a_dy = 0.5 * k.twelve_mu_a * k.dy
    Bd = viscous_drop(integral, d_sep, six_mu_a_dy)
    q = slice_flux(k.P_s, d_min, d_sep, 1.0 / (Bd + flux_root(k.P_s, Bd, k.half_rho_a)))
    integral = 0.0
    for j in range(ny - 1, -1, -1):
        on_the_lung_side = j > j_sep or (not is_open(d_min) and j == j_sep)
        p[j] = pressure(k.P_s, q, square(1.0 / d[j]), integral, k.half_rho_a, six_mu_a_dy) if on_the_lung_side else 0.0
        if j > 0:
            for r in (1.0 / d[j], 1.0 / d[j - 1]):
                integral = half_segment(integral, square(r), r)
    return opening(d_min), q


@jit
def _advance(w, v, w_b, v_b, G, K_coup, B, load, k, dt, steps, force, p, d, record):
    """March ``steps`` steps; ``record`` (steps, 3) gets area, m², flow, m³/s, and largest contact pressure, Pa."""
    ny, nx = w.shape
    for n in range(steps):
        area, flow_rate, largest = 0.0, 0.0, 0.0
        for i in range(1, nx):
            d_min, q = _slice_pressure(w, G, i, k, p, d)
            area += d_min * (0.5 * k.dx if i == nx - 1 else k.dx)
            flow_rate += q * (0.5 * k.dx if i == nx - 1 else k.dx)
            if i == nx - 1:
                continue
            to_beam = 0.0
            for j in range(ny):
                traction = traction_of(w[j, i], v[j, i], w_b[i], k.C_coup * v_b[i], K_coup[j], k.C_coup)
                to_beam += traction * (0.5 if j == 0 or j == ny - 1 else 1.0)
                sheared = 0.0
                for other in (j - 1, j + 1):
                    if 0 <= other < ny:
                        strain, rate = (w[other, i] - w[j, i]) / k.dy, (v[other, i] - v[j, i]) / k.dy
                        cell = 0.5 * k.dy if j == 0 or j == ny - 1 else k.dy
                        sheared += kelvin_voigt(strain, rate, k.G_shear, k.eta_shear) / cell
                p_col = contact_pressure(w[j, i] - G[j, i], v[j, i], k.K_col, k.C_col)
                largest = max(p_col, largest)
                along = along_fold(w[j, i - 1], w[j, i], w[j, i + 1], k.T_over_dx2)
                force[j, i] = (along + sheared - traction - p[j] - p_col) / k.rho_s
            line = to_beam * k.dy - k.K_foun * w_b[i] - k.C_foun * v_b[i] + load[i - 1]
            for m in range(max(0, i - 3), min(nx - 2, i + 2)):
                line += B[i - 1, m] * w_b[m + 1]
            force[ny, i] = line / k.rho_l
        record[n, 0], record[n, 1], record[n, 2] = area, flow_rate, largest
        for i in range(1, nx - 1):
            for j in range(ny):
                v[j, i] += dt * force[j, i]
                w[j, i] += dt * v[j, i]
            v_b[i] += dt * force[ny, i]
            w_b[i] += dt * v_b[i]


def plain_run(fold: Fold, P_s_pa: float, duration_s: float, step_s: float = STEP_S) -> np.ndarray:
    """Record (steps, 3) from the flat start: minimum glottal area, m², flow, m³/s, and largest contact pressure, Pa."""
    c, constants = fold.coefficients, fold.constants
    laws = Laws(
        dx=fold.dx,
        dy=fold.dy,
        P_s=P_s_pa,
        alpha_s=constants.alpha_s,
        half_rho_a=0.5 * constants.rho_a_kg_m3,
        twelve_mu_a=12.0 * constants.mu_a_pa_s,
        T_over_dx2=c.membrane_tension_n_m / fold.dx**2,
        G_shear=c.membrane_shear_n_m,
        eta_shear=c.membrane_shear_viscosity_n_s_m,
        C_coup=constants.C_coup_pa_s_m,
        K_col=constants.K_col_pa_m,
        C_col=constants.C_col_pa_s_m,
        K_foun=constants.K_foun_pa,
        C_foun=constants.C_foun_pa_s,
        rho_s=c.membrane_density_kg_m2,
        rho_l=c.beam_density_kg_m,
    )
    w = 1e-9 * np.sin(np.pi * fold.y_m / fold.y_m[-1])[:, None] * np.sin(np.pi * fold.x_m / fold.x_m[-1])
    w[:, [0, -1]] = 0.0
    record = np.empty((round(duration_s / step_s), 3))
    v, w_b, v_b = np.zeros_like(w), np.zeros(fold.nx), np.zeros(fold.nx)
    force, p, d = np.empty((fold.ny + 1, fold.nx)), np.empty(fold.ny), np.empty(fold.ny)
    fixed = fold.medial_plane_m, fold.field("coupling")[:, 0], fold.beam_matrix_n_m2, fold.beam_load_n_m
    _advance(w, v, w_b, v_b, *fixed, laws, step_s, len(record), force, p, d, record)
    return record
