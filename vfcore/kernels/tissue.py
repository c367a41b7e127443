"""Coefficients of the prestrained fold from strain and TA activation: the formulas, plain floats in and out.

Engineering stress of layer i (paper, constitutive relations), Pa of resting area, strain of the resting length:

    passive    σ_p(ε) = −(σ_1/ε_1)(ε − ε_1)  +  [ε ≥ ε_2] σ_2 ( exp(α_1(ε − ε_2)) − 1 − α_1(ε − ε_2) )
    active     σ_a(ε) = a σ_a,max · max(0, 1 − α_2 (ε − ε_m)²),   TA only

The other equations and their sources are in vfcore/larynx/tissue/coefficients.py and beam.py, which name the numbers
and refuse a fold without stiffness, and in vfcore/fold/stability.py for the step. ``c`` is any object with the
attributes of FoldConstants. SI units. Algebraic: no discretisation but for ``beam_ends`` and ``beam_bands`` (order 2 in
dx). Python and compiled code run the same lines (``formula``); the results differ by rounding. Twin:
tests/support/coefficient_twin.py. Not validated against measured tissue.
"""

import math
from typing import NamedTuple

from vfcore.kernels.jit import formula


class Constants(NamedTuple):
    """Constants of the fold used by these formulas; names and units of vfcore.spec.fold_constants.FoldConstants."""

    L_0_m: float
    b_0_m: float
    A_muc_0_m2: float
    A_lig_0_m2: float
    A_ta_0_m2: float
    rho_muc_kg_m3: float
    rho_lig_kg_m3: float
    rho_ta_kg_m3: float
    sigma_1_muc_pa: float
    sigma_1_lig_pa: float
    sigma_1_ta_pa: float
    epsilon_1_muc: float
    epsilon_1_lig: float
    epsilon_1_ta: float
    sigma_2_muc_pa: float
    sigma_2_lig_pa: float
    sigma_2_ta_pa: float
    epsilon_2_muc: float
    epsilon_2_lig: float
    epsilon_2_ta: float
    alpha_1_muc: float
    alpha_1_lig: float
    alpha_1_ta: float
    sigma_a_max_ta_pa: float
    epsilon_m_ta: float
    alpha_2_ta: float
    alpha_s: float
    rho_a_kg_m3: float
    mu_a_pa_s: float
    K_coup_min_pa_m: float
    K_coup_max_pa_m: float
    C_coup_pa_s_m: float
    K_foun_pa: float
    C_foun_pa_s: float
    K_col_pa_m: float
    C_col_pa_s_m: float
    G_m_pa: float
    eta_m_pa_s: float
    K_r_a_n_m: float
    K_r_p_n_m: float


@formula
def passive(strain, sigma_1, epsilon_1, sigma_2, epsilon_2, alpha_1):
    """Passive engineering stress of one layer, Pa, and its slope, Pa."""
    linear = -sigma_1 / epsilon_1
    sigma, slope = linear * (strain - epsilon_1), linear
    if strain > epsilon_2:
        growth = math.exp(alpha_1 * (strain - epsilon_2))
        sigma += sigma_2 * (growth - 1 - alpha_1 * (strain - epsilon_2))
        slope += sigma_2 * alpha_1 * (growth - 1)
    return sigma, slope


@formula
def active(strain, activation, sigma_max, alpha_2, epsilon_m):
    """Active engineering stress of the TA muscle, Pa, and its slope, Pa."""
    shape = 1 - alpha_2 * (strain - epsilon_m) ** 2
    if shape <= 0:
        return 0.0, 0.0
    return activation * sigma_max * shape, -2 * activation * sigma_max * alpha_2 * (strain - epsilon_m)


@formula
def prestrained(strain, a_ta, c):
    """The fields of ``Coefficients`` in their order, then the axial stiffness of the beam, N.

    If the axial stiffness is not positive, the bending numbers are meaningless.
    """
    lam = 1.0 + strain
    root = lam**0.5
    b = c.b_0_m / root
    d_muc, d_lig, d_ta = c.A_muc_0_m2 / c.b_0_m / root, c.A_lig_0_m2 / c.b_0_m / root, c.A_ta_0_m2 / c.b_0_m / root
    A_lig, A_ta = c.A_lig_0_m2 / lam, c.A_ta_0_m2 / lam

    sigma_muc, E_muc = passive(
        strain, c.sigma_1_muc_pa, c.epsilon_1_muc, c.sigma_2_muc_pa, c.epsilon_2_muc, c.alpha_1_muc
    )
    sigma_lig, E_lig = passive(
        strain, c.sigma_1_lig_pa, c.epsilon_1_lig, c.sigma_2_lig_pa, c.epsilon_2_lig, c.alpha_1_lig
    )
    sigma_p, E_p = passive(strain, c.sigma_1_ta_pa, c.epsilon_1_ta, c.sigma_2_ta_pa, c.epsilon_2_ta, c.alpha_1_ta)
    sigma_a, E_a = active(strain, a_ta, c.sigma_a_max_ta_pa, c.alpha_2_ta, c.epsilon_m_ta)
    sigma_ta, E_ta = sigma_p + sigma_a, E_p + E_a

    depth = d_ta + d_lig
    EA_lig, EA_ta = E_lig * A_lig, E_ta * A_ta
    axial = EA_lig + EA_ta
    twice = 2 * axial if axial > 0.0 else math.nan
    alpha_lig = -depth * EA_ta / twice
    alpha_ta = depth * EA_lig / twice
    r_ta, r_lig = d_ta / 2, d_ta + d_lig / 2
    r_c = r_lig
    mu_c = lam**2 * (
        E_lig * (b * d_lig**3 / 12 + (r_c - r_lig) * A_lig * alpha_lig)
        + E_ta * (b * d_ta**3 / 12 + (r_c - r_ta) * A_ta * alpha_ta)
    )
    N_b = lam * (A_lig * sigma_lig + A_ta * sigma_ta)
    M_c = lam * ((r_c - r_lig) * A_lig * sigma_lig + (r_c - r_ta) * A_ta * sigma_ta)
    return (
        lam, lam * c.L_0_m, b,
        d_muc * lam**1.5 * lam * sigma_muc, d_muc / lam * c.G_m_pa, d_muc / lam * c.eta_m_pa_s,
        c.rho_muc_kg_m3 * d_muc, lam * c.rho_muc_kg_m3 * d_muc**2 / 12,
        lam**1.5 * N_b, lam**1.5 * mu_c, M_c, c.rho_lig_kg_m3 * A_lig + c.rho_ta_kg_m3 * A_ta,
        d_muc, sigma_muc, sigma_lig, sigma_ta, E_muc, E_lig, E_ta, axial,
    )  # fmt: skip


@formula
def medial_plane(x, y, opening, leaning):
    """G, m: distance of the medial plane in the frame of the fold. ``opening``: tan θ_g; ``leaning``: tan θ_conv."""
    return x * opening + y * leaning


@formula
def coupling_stiffness(from_stiff_edge, c):
    """K_coup, Pa/m, at a fraction 0 to 1 of the thickness from the stiffer edge."""
    return c.K_coup_max_pa_m + (c.K_coup_min_pa_m - c.K_coup_max_pa_m) * from_stiff_edge


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


@formula
def step_numbers(dt, dx, dy, T, G_t, eta_t, rho_l, J, c):
    """The values of layout.SCALARS in their order; T, G_t, eta_t, rho_l and J as from ``prestrained``."""
    return (
        dt, dy, c.alpha_s, 0.5 * c.rho_a_kg_m3, 12.0 * c.mu_a_pa_s,
        T / dx**2, G_t / dy**2, eta_t / dy**2,
        c.C_coup_pa_s_m, c.K_col_pa_m, c.C_col_pa_s_m, c.K_foun_pa, c.C_foun_pa_s,
        1.0 / rho_l, 1.0 / J, c.G_m_pa, c.eta_m_pa_s,
    )  # fmt: skip


@formula
def longest_step(rotation, dx, dy, T, G_t, eta_t, rho_s, J, b, rho_l, K_coup, c):
    """The time step at which the first mode would grow, s: the bound of vfcore/fold/stability.py without its margin.

    ``K_coup``: the stiffest coupling, Pa/m.
    """
    shear = 4.0 / dy**2
    stretch = 4.0 * T / dx**2 + shear * G_t
    membrane_omega2 = (stretch + c.K_col_pa_m) / rho_s
    membrane_rate = (shear * eta_t + c.C_col_pa_s_m) / rho_s
    if rotation:
        membrane_omega2 += c.G_m_pa / J
        membrane_rate += c.eta_m_pa_s / J
    inv_reduced_mass = 1.0 / rho_s + b / rho_l
    omega2 = K_coup * inv_reduced_mass
    rate = c.C_coup_pa_s_m * inv_reduced_mass
    return min(
        _critical_step(membrane_omega2 + omega2, membrane_rate + rate),
        _critical_step(c.K_foun_pa / rho_l + omega2, c.C_foun_pa_s / rho_l + rate),
    )


@formula
def _critical_step(omega2, rate):
    """The step at which s/3 + a = 1, s; infinite without spring and damper."""
    weight = rate + math.sqrt(rate**2 + 4.0 / 3.0 * omega2)
    return 2.0 / weight if weight > 0.0 else math.inf
