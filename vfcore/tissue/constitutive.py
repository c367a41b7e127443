"""Engineering stress–strain laws of the three layers, and their slopes.

Passive (paper, constitutive relations), per layer i:

    σ_p(ε) = −(σ_1/ε_1)(ε − ε_1)  +  [ε ≥ ε_2] σ_2 ( exp(α_1(ε − ε_2)) − 1 − α_1(ε − ε_2) )

Active (TA only):

    σ_a(ε) = a σ_a,max · max(0, 1 − α_2 (ε − ε_m)²)

Stress is force per resting area, Pa; strain is relative to the resting length.
"""

import math
from typing import NamedTuple


class Stress(NamedTuple):
    """Engineering stress σ̄, Pa, and its slope E = dσ̄/dε, Pa."""

    sigma_pa: float
    slope_pa: float


def passive(
    strain: float, sigma_1: float, epsilon_1: float, sigma_2: float, epsilon_2: float, alpha_1: float
) -> Stress:
    """Passive engineering stress of one layer and its slope at ``strain``."""
    linear = -sigma_1 / epsilon_1
    sigma, slope = linear * (strain - epsilon_1), linear
    if strain > epsilon_2:
        growth = math.exp(alpha_1 * (strain - epsilon_2))
        sigma += sigma_2 * (growth - 1 - alpha_1 * (strain - epsilon_2))
        slope += sigma_2 * alpha_1 * (growth - 1)
    return Stress(sigma, slope)


def active(strain: float, activation: float, sigma_max: float, alpha_2: float, epsilon_m: float) -> Stress:
    """Active engineering stress of the TA muscle and its slope at ``strain``."""
    shape = 1 - alpha_2 * (strain - epsilon_m) ** 2
    if shape <= 0:
        return Stress(0.0, 0.0)
    return Stress(
        activation * sigma_max * shape,
        -2 * activation * sigma_max * alpha_2 * (strain - epsilon_m),
    )
