"""Coefficients of the prestrained fold from strain and TA activation: the formulas, plain floats in and out.

Engineering stress of layer i (paper, constitutive relations), Pa of resting area, strain of the resting length:

    passive    σ_p(ε) = −(σ_1/ε_1)(ε − ε_1)  +  [ε ≥ ε_2] σ_2 ( exp(α_1(ε − ε_2)) − 1 − α_1(ε − ε_2) )
    active     σ_a(ε) = a σ_a,max · max(0, 1 − α_2 (ε − ε_m)²),   TA only

The other equations and their sources are in vfcore/larynx/tissue/coefficients.py, which names the numbers and refuses a
fold without stiffness. ``c`` is any object with the attributes of FoldConstants. SI units. Algebraic: no
discretisation. Python and compiled code run the same lines (``formula``); the results differ by rounding. Twin:
tests/support/coefficient_twin.py. Not validated against measured tissue.
"""

import math
from dataclasses import fields
from typing import Any, NamedTuple

from vfcore.fold.constants import FoldConstants
from vfcore.kernels.jit import formula

#: The constants of a fold as plain floats: what compiled code takes in the place of FoldConstants, with the same names.
Constants: Any = NamedTuple("Constants", [(spec.name, float) for spec in fields(FoldConstants)])  # type: ignore[misc]  # mypy wants a literal list


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
