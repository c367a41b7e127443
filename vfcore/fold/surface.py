"""Pressures on the medial surface of one state, for pictures: the laws of terms/air.py and contact.py, node by node.

    p_aero, p_col at node (i, j) from half opening and closing speed at the same instant
                                                        [eqs. ViscousBernoulliPressure, ContactModel]

The step stores no pressure fields. This computes them from a stored state with the same laws, at the velocity that the
step would use (extrapolated to the time of the displacement). They are instantaneous: where a slice closes or opens
within a step, the step itself uses the mean over the step. Per column two passes from the inlet: the first finds the
flux, the second the pressures. Order, stability and validation as in those files; compared with the step in
tests/physics/test_kernel_surface.py.
"""

import math

from vfcore.fold.terms import air, contact
from vfcore.kernels.jit import jit

contact_pressure = contact.contact_pressure
gap, separation_gap, attached, square = air.gap, air.separation_gap, air.attached, air.square
is_open, half_segment, viscous_drop = air.is_open, air.half_segment, air.viscous_drop
flux_root, slice_flux, pressure = air.flux_root, air.slice_flux, air.pressure


@jit
def surface_pressures(half, speed, inlet, outlet, dy, alpha_s, half_rho_a, twelve_mu_a, K_col, C_col, p_aero, p_col):
    """Fill ``p_aero`` and ``p_col`` (ny, nx), Pa, from the half opening ``half`` (m) and the closing speed ``speed``
    (m/s) of both walls, (ny, nx).

    ``inlet``, ``outlet``: pressure below and above the glottis, Pa (P_s and 0 with one-way coupling). ``K_col`` and
    ``C_col`` (ny, nx) of the pair of walls.
    """
    ny, nx = half.shape
    six_mu_a_dy = 0.5 * twelve_mu_a * dy
    for i in range(nx):
        d_min, d_max = math.inf, 0.0
        for j in range(ny):
            d = gap(half[j, i])
            d_min, d_max = min(d, d_min), max(d, d_max)
        d_sep = separation_gap(d_min, d_max, alpha_s)
        integral, upstream = 0.0, math.inf
        for k in range(ny):  # first pass: the flux, from the integral down to separation
            j = ny - 1 - k
            running = min(gap(half[j, i]), upstream)
            on = attached(running, d_sep)
            upstream = running
            if j > 0 and on:
                for r in (1.0 / gap(half[j, i]), 1.0 / gap(half[j - 1, i])):
                    integral = half_segment(integral, square(r), r)
        Bd = viscous_drop(integral, d_sep, six_mu_a_dy)
        root = flux_root(inlet - outlet, Bd, half_rho_a)
        q = slice_flux(inlet - outlet, d_min, d_sep, 1.0 / (Bd + root))
        integral, upstream = 0.0, math.inf
        for k in range(ny):
            j = ny - 1 - k
            d = gap(half[j, i])
            running = min(d, upstream)
            on = attached(running, d_sep) or (not is_open(d_min) and attached(upstream, d_sep))
            upstream = running
            attached_pressure = pressure(inlet, q, square(1.0 / d), integral, half_rho_a, six_mu_a_dy)
            p_aero[j, i] = attached_pressure if on else outlet
            p_col[j, i] = contact_pressure(-half[j, i], speed[j, i], K_col[j, i], C_col[j, i])
            if j > 0 and on:
                for r in (1.0 / d, 1.0 / gap(half[j - 1, i])):
                    integral = half_segment(integral, square(r), r)
