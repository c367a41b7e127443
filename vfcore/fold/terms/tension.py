"""Tension along the fold: of the membrane, and what the swing adds to that of the beam.

    membrane   T_j ∂_xx w        →  T_j/dx² (w_{i−1} − 2 w_i + w_{i+1})          [eq. MembraneEqn]

linear: T_j = T̃_m, constant, as in the paper. finite: the paper linearises about the prestrain ε̄; the von Kármán term
keeps the stretch by the displacement, shared along x, since longitudinal waves are fast:

    ε_j(t) = ε̄ + e_j,   e_j = (λ/2) mean_x (∂_x w)²      →  λ/(2 (nx−1) dx²) Σ_i (w_{i+1} − w_i)²
    T_j(t) = d_muc λ^{3/2} λ σ̄_muc(ε_j)

with the paper's exponential law itself. The depth, the stretch ratio and the shear stay those of the prestrain, so at
w = 0 this is T̃_m. The beam likewise: N(e_b) from σ̄_lig and σ̄_ta with e_b from w_b; N(e_b) − N(0) is an explicit load,
and the bending stiffness and the end moments stay those of the prestrain.

A tension that varies over the surface has a share τ on the intervals along x: T_j ∂_x(τ ∂_x w), with
e_j = (λ/2) mean τ (∂_x w)². Then the force is minus the derivative of the stored energy

    V = Σ_j m_j L Φ(e_j/λ),   dΦ/ds = T(ε̄ + λ s),   m_j: dy, half of it in an edge row

Law of a layer in terms of e, with z = z_0 + α_1 e, z_0 = α_1 (ε̄ − ε_2):

    A + B e + C (e^z − 1 − z) [z > 0]

Static: the same forces, with T_j and N of the shape (vfcore/fold/statics.py). Loss: none.
Numbers of T are over dx², Pa/m; those of N over dx², N/m². Floats or SIMD vectors. Order 2 in dx. Stability: ω² of
4 T/dx² over ρ_s, with finite stretch at the largest swing (``SWING_PA``), and of what that adds to the beam, 4 N/dx²
over ρ_l. Twin: tests/support/wall_twin.py. Not validated against measured vibration.
"""

import math

import numpy as np

from vfcore.kernels.elementary import exponential
from vfcore.kernels.jit import formula, jit
from vfcore.kernels.simd import load, maximum, minimum, paired
from vfcore.larynx.tissue.prestrain import active, passive

#: Pressure of the largest swing for which the stability bound holds, Pa: a row with the tension T at the stretch e
#: balances about T √e/L. The paper's modal voice reaches 1.25 times its lung pressure in this measure (at 2 kPa e is
#: 0.33), so this is about twice the pressure of loud speech.
SWING_PA = 2500.0
#: Largest exponent: far above any tissue strain, and finite in single precision.
LARGEST_EXPONENT = 40.0

#: T̃_m/dx²; gain of e_j from Σ (w_{i+1} − w_i)²; the law of T/dx² in terms of e_j.
MEMBRANE = ("T_over_dx2", "stretch_gain", "T_A", "T_B", "T_C", "T_z", "T_alpha")
#: Gain of e_b; N/dx² − Ñ_b/dx²: linear part, exponential parts of ligament and TA, active part of TA.
AXIAL = (
    "beam_gain", "N_A", "N_B", "N_lig_C", "N_lig_z", "N_lig_alpha", "N_ta_C", "N_ta_z", "N_ta_alpha",
    "N_active", "N_active_alpha", "N_active_offset",
)  # fmt: skip
NUMBERS = (*MEMBRANE, *AXIAL)  # filled by vfcore/fold/assembly.py from the functions below


@jit
def tension(w_before, w, w_after, T_over_dx2):
    """T ∂_xx w, Pa."""
    return T_over_dx2 * (w_before - 2.0 * w + w_after)


@jit
def varying_tension(w_before, w, w_after, share_before, share_after, T_over_dx2):
    """T ∂_x(τ ∂_x w), Pa; τ on the intervals before and after the node."""
    return T_over_dx2 * (share_after * (w_after - w) - share_before * (w - w_before))


@jit
def layer(e, C, z_0, alpha):
    """The exponential part of a layer's law at stretch ``e`` above the prestrain, in the units of ``C``."""
    z = minimum(maximum(z_0 + alpha * e, 0.0), LARGEST_EXPONENT)
    return C * (exponential(z) - 1.0 - z)


@jit
def stretched(e, A, B, C, z_0, alpha):
    """T_j/dx², Pa/m, at stretch ``e`` above the prestrain."""
    return A + B * e + layer(e, C, z_0, alpha)


@jit
def active_tension(e, active, active_alpha, active_offset):
    """The active part of the beam's tension over dx², N/m², at stretch ``e`` above the prestrain."""
    offset = active_offset + e
    return active * maximum(1.0 - active_alpha * offset * offset, 0.0)


@jit
def axial(e, A, B, lig_C, lig_z, lig_alpha, ta_C, ta_z, ta_alpha, active, active_alpha, active_offset):
    """(N − Ñ_b)/dx² of the beam, N/m², at stretch ``e`` above the prestrain."""
    passive = stretched(e, A, B, lig_C, lig_z, lig_alpha) + layer(e, ta_C, ta_z, ta_alpha)
    return passive + active_tension(e, active, active_alpha, active_offset)


@jit
def sums_of_eight(buf, at):
    """The sums of eight vectors of eight numbers stored from ``at`` on, as one vector."""
    half_1 = paired(
        paired(load(buf, at, 8), load(buf, at + 8, 8), 4), paired(load(buf, at + 16, 8), load(buf, at + 24, 8), 4), 2
    )
    half_2 = paired(
        paired(load(buf, at + 32, 8), load(buf, at + 40, 8), 4),
        paired(load(buf, at + 48, 8), load(buf, at + 56, 8), 4),
        2,
    )
    return paired(half_1, half_2, 1)


@formula
def law_of(strain, scale, sigma_1, epsilon_1, sigma_2, epsilon_2, alpha_1):
    """A, B, C, z_0 and α_1 of ``scale`` times the passive stress of a layer whose prestrain is ``strain``."""
    slope = -sigma_1 / epsilon_1
    return scale * slope * (strain - epsilon_1), scale * slope, scale * sigma_2, alpha_1 * (strain - epsilon_2), alpha_1


@formula
def membrane_numbers(strain, lam, T, dx, nx, c):
    """The values of MEMBRANE; ``T``: T̃_m, N/m, to which the law is scaled, so that it holds at w = 0."""
    sigma = passive(strain, c.sigma_1_muc_pa, c.epsilon_1_muc, c.sigma_2_muc_pa, c.epsilon_2_muc, c.alpha_1_muc)[0]
    T_over_dx2 = T / dx**2
    A, B, C, z_0, alpha = law_of(
        strain, T_over_dx2 / sigma, c.sigma_1_muc_pa, c.epsilon_1_muc, c.sigma_2_muc_pa, c.epsilon_2_muc, c.alpha_1_muc
    )
    return T_over_dx2, 0.5 * lam / ((nx - 1) * dx**2), A, B, C, z_0, alpha


@formula
def axial_numbers(strain, a_ta, lam, dx, nx, c):
    """The values of AXIAL."""
    lig_m2, ta_m2 = lam**1.5 * c.A_lig_0_m2, lam**1.5 * c.A_ta_0_m2  # λ^{5/2} A_i
    lig_A, lig_B, lig_C, lig_z, lig_alpha = law_of(
        strain, lig_m2 / dx**2, c.sigma_1_lig_pa, c.epsilon_1_lig, c.sigma_2_lig_pa, c.epsilon_2_lig, c.alpha_1_lig
    )
    ta_A, ta_B, ta_C, ta_z, ta_alpha = law_of(
        strain, ta_m2 / dx**2, c.sigma_1_ta_pa, c.epsilon_1_ta, c.sigma_2_ta_pa, c.epsilon_2_ta, c.alpha_1_ta
    )
    N_active = a_ta * c.sigma_a_max_ta_pa * ta_m2 / dx**2
    lig = passive(strain, c.sigma_1_lig_pa, c.epsilon_1_lig, c.sigma_2_lig_pa, c.epsilon_2_lig, c.alpha_1_lig)[0]
    ta = passive(strain, c.sigma_1_ta_pa, c.epsilon_1_ta, c.sigma_2_ta_pa, c.epsilon_2_ta, c.alpha_1_ta)[0]
    ta += active(strain, a_ta, c.sigma_a_max_ta_pa, c.alpha_2_ta, c.epsilon_m_ta)[0]
    at_rest = (lig * lig_m2 + ta * ta_m2) / dx**2
    return (
        0.5 * lam / ((nx - 1) * dx**2), lig_A + ta_A - at_rest, lig_B + ta_B,
        lig_C, lig_z, lig_alpha, ta_C, ta_z, ta_alpha, N_active, c.alpha_2_ta, strain - c.epsilon_m_ta,
    )  # fmt: skip


@jit
def bound(finite, numbers, largest_share, length, dx):
    """Largest stiffness of the membrane, Pa/m, and of the beam beyond its prestrain, N/m². ``numbers``: NUMBERS."""
    n = numbers
    T, N = n[0], 0.0
    if finite:
        e, above = 0.0, 4.0
        for _ in range(40):  # T √e is increasing
            middle = 0.5 * (e + above)
            if stretched(middle, n[2], n[3], n[4], n[5], n[6]) * dx * dx * math.sqrt(middle) < SWING_PA * length:
                e = middle
            else:
                above = middle
        T = max(T, stretched(e, n[2], n[3], n[4], n[5], n[6]))
        N = axial(e, n[8], n[9], n[10], n[11], n[12], n[13], n[14], n[15], n[16], n[17], n[18])
    return 4.0 * T * largest_share, 4.0 * max(N, 0.0)


@jit
def tensions(w, w_b, share, numbers, T):
    """Fill ``T`` (ny,) with the tension of each row over dx², Pa/m, at a shape with finite stretch; return that of the
    beam beyond its prestrain, N/m². ``w`` and ``share`` (ny, nx), ``w_b`` (nx,), ``numbers``: NUMBERS.
    """
    ny, nx = w.shape
    n = numbers
    for j in range(ny):
        total = 0.0
        for i in range(nx - 1):
            total += share[j, i] * (w[j, i + 1] - w[j, i]) ** 2
        T[j] = stretched(n[1] * total, n[2], n[3], n[4], n[5], n[6])
    total = 0.0
    for i in range(nx - 1):
        total += (w_b[i + 1] - w_b[i]) ** 2
    return axial(n[7] * total, n[8], n[9], n[10], n[11], n[12], n[13], n[14], n[15], n[16], n[17], n[18])


@jit
def static(band, T, share, cell, at, block):
    """Add the tension of a wall to the static matrix, as vfcore/fold/equilibrium.py stores it.

    ``T`` (ny,) over dx²; ``share`` (ny, nx); ``cell`` (ny,): heights m_j; ``at``: place of the wall's first row in a
    column of ``block`` unknowns.
    """
    ny, nx = share.shape
    for i in range(nx - 2):
        for j in range(ny):
            k, pull = i * block + at + j, cell[j] * T[j]
            band[k, 0] += pull * (share[j, i] + share[j, i + 1])
            if i < nx - 3:
                band[k, block] -= pull * share[j, i + 1]


def energy(w: np.ndarray, w_b: np.ndarray, share: np.ndarray, cell: np.ndarray, dx: float, numbers, finite: bool):
    """Stored by the membrane of a wall, and by the beam beyond its prestrain, J.

    ``w`` and ``share`` (ny, nx), ``w_b`` (nx,), ``cell`` (ny,): heights m_j, m. ``numbers``: NUMBERS.
    """
    n = numbers
    squares = (share[:, :-1] * np.diff(w, axis=1) ** 2).sum(axis=1)
    if not finite:
        return float(0.5 * n[0] * dx * (cell * squares).sum()), 0.0
    rows = [_work(n[1] * square, n[2], n[3], n[4], n[5], n[6]) for square in squares]
    e = n[7] * float((np.diff(w_b) ** 2).sum())
    beam = _work(e, n[8], n[9], n[10], n[11], n[12]) + _work(e, 0.0, 0.0, n[13], n[14], n[15])
    beam += n[16] * _active_work(e, n[17], n[18])
    return float(0.5 * dx / n[1] * (cell * np.array(rows)).sum()), 0.5 * dx / n[7] * beam


def _work(e, A, B, C, z_0, alpha):
    """∫ of ``stretched`` from 0 to ``e``."""
    low, high = max(z_0, 0.0), max(z_0 + alpha * e, 0.0)
    exponential_part = 0.0
    if alpha > 0.0:
        exponential_part = math.exp(high) - math.exp(low) - (high - low) - 0.5 * (high**2 - low**2)
        exponential_part *= C / alpha
    elif z_0 > 0.0:
        exponential_part = C * (math.exp(z_0) - 1.0 - z_0) * e
    return A * e + 0.5 * B * e**2 + exponential_part


def _active_work(e, alpha, offset):
    """∫ of 1 − α_2 (offset + e)², where it is positive, from 0 to ``e``."""
    reach = math.inf if alpha <= 0.0 else alpha**-0.5
    low, high = (min(max(value, -reach), reach) for value in (offset, offset + e))
    return high - low - alpha * (high**3 - low**3) / 3.0
