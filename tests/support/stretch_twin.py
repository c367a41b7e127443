"""Stress of a layer at any strain, and its integral over strain: the laws behind finite stretch.

Source: the constitutive laws of Serry, Zañartu & Peterson (2026). Along a membrane row, or along the beam, a deflection
w(x) that is fixed at both ends lengthens the fold. With the mean square slope as engineering strain of the prestrained
length (von Kármán), the strain of the resting length becomes

    ε = ε̄ + λ e,    e = ½ mean_x τ (∂_x w)²          τ: local ratio of the tension, 1 in a uniform fold

The stress does not vary along x, because longitudinal waves are fast compared with the voice. With T̃(ε) the tension of
the prestrained fold, everything but the stress taken at the prestrain, a row of length L has the energy per height

    V = L ∫₀^e T̃(ε̄ + λ e') de',      −δV/δw = ∂_x(τ T̃(ε) ∂_x w)

Strains may be arrays. SI units.
"""

import numpy as np

from tests.support.coefficient_twin import TwinCoefficients
from vfcore.fold.constants import FoldConstants


def _numbers(constants: FoldConstants, layer: str):
    names = ("sigma_1_{}_pa", "epsilon_1_{}", "sigma_2_{}_pa", "epsilon_2_{}", "alpha_1_{}")
    return (getattr(constants, name.format(layer)) for name in names)


def layer_stress(constants: FoldConstants, layer: str, a_ta: float, strain):
    """Engineering stress of a layer ("muc", "lig" or "ta"), Pa; the active stress of TA included."""
    sigma_1, epsilon_1, sigma_2, epsilon_2, alpha = _numbers(constants, layer)
    strain = np.asarray(strain, dtype=float)
    stretch = alpha * np.maximum(strain - epsilon_2, 0.0)
    stress = -sigma_1 / epsilon_1 * (strain - epsilon_1) + sigma_2 * (np.exp(stretch) - 1 - stretch)
    if layer == "ta":
        hump = 1 - constants.alpha_2_ta * (strain - constants.epsilon_m_ta) ** 2
        stress = stress + a_ta * constants.sigma_a_max_ta_pa * np.maximum(hump, 0.0)
    return stress


def layer_work(constants: FoldConstants, layer: str, a_ta: float, start: float, end):
    """∫ of ``layer_stress`` over the strain from ``start`` to ``end``, Pa, in closed form."""

    def primitive(strain):
        sigma_1, epsilon_1, sigma_2, epsilon_2, alpha = _numbers(constants, layer)
        stretch = alpha * np.maximum(strain - epsilon_2, 0.0)
        total = -sigma_1 / epsilon_1 * (strain**2 / 2 - epsilon_1 * strain)
        total = total + sigma_2 / alpha * (np.exp(stretch) - 1 - stretch - stretch**2 / 2)
        if layer == "ta":
            reach = constants.alpha_2_ta**-0.5  # of the active stress to each side of its maximum
            within = np.clip(strain - constants.epsilon_m_ta, -reach, reach)
            total = total + a_ta * constants.sigma_a_max_ta_pa * (within - constants.alpha_2_ta * within**3 / 3)
        return total

    return primitive(np.asarray(end, dtype=float)) - primitive(np.asarray(start, dtype=float))


def mean_square_stretch(w, dx: float, tau=1.0):
    """e = ½ mean τ (∂_x w)² over the intervals along the first axis; ``w`` with its fixed ends, m."""
    return (tau * (np.diff(w, axis=0) / dx) ** 2).mean(axis=0) / 2


def membrane_tension(constants: FoldConstants, k: TwinCoefficients, strain):
    """T̃ at a strain, N/m: d_muc λ^{3/2} λ σ̄_muc(ε), with depth and λ of the prestrain ``k``."""
    return k.d_muc * k.lam**1.5 * k.lam * layer_stress(constants, "muc", 0.0, strain)


def beam_force(constants: FoldConstants, k: TwinCoefficients, a_ta: float, strain):
    """Ñ_b at a strain, N: λ^{3/2} λ Σ A_i σ̄_i(ε) over ligament and TA, with areas and λ of the prestrain ``k``."""
    pull = k.A_lig * layer_stress(constants, "lig", a_ta, strain) + k.A_ta * layer_stress(constants, "ta", a_ta, strain)
    return k.lam**1.5 * k.lam * pull


def membrane_work(constants: FoldConstants, k: TwinCoefficients, nominal: float, e):
    """∫₀^e T̃(ε̄ + λ e') de', N/m; ``nominal`` is ε̄."""
    return k.d_muc * k.lam**1.5 * layer_work(constants, "muc", 0.0, nominal, nominal + k.lam * e)


def beam_work(constants: FoldConstants, k: TwinCoefficients, a_ta: float, nominal: float, e):
    """∫₀^e Ñ_b(ε̄ + λ e') de', N; ``nominal`` is ε̄."""
    end = nominal + k.lam * e
    work = k.A_lig * layer_work(constants, "lig", a_ta, nominal, end)
    work = work + k.A_ta * layer_work(constants, "ta", a_ta, nominal, end)
    return k.lam**1.5 * work
