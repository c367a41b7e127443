"""Constants of the cricoarytenoid and cricothyroid joints, common to all published sets.

Stiffness laws of Titze & Hunter (2007) as implemented by Alzamendi et al. (2022); d_t = L_0 ε_t and
d_r = L_0 ε_r are the fold's elongations by translation and by rotation of the cricothyroid joint,
a = d_r/h its rotation, ⟨z⟩ = max(0, z):

    k_x = 60 (1 + 2e5 ξ² + 2e13 ⟨|ξ| − 3 mm⟩⁴)          k_y = 200 (1 + 2e5 ψ² + 2e13 ⟨|ψ| − 3 mm⟩⁴)
    κ = 0.005 (1 + 10 θ² + 1e4 ⟨|θ| − 0.3⟩⁴)             κ_col = 20 κ/R, T ∝ Δθ + 500 Δθ³
    k_t = 500 (1 + (30/π) |a|) (1 + 1e6 d_t² + 2e14 ⟨|d_t| − 1.5 mm⟩⁴)
    k_r = 0.05 (1 + 1500 |d_t|) (1 + 40 a² + 2e5 ⟨|a| − 0.2⟩⁴)
"""

import math
from dataclasses import dataclass

from vfcore.spec.fields import quantity

_CAJ = "cricoarytenoid joint, Titze & Hunter (2007) as used by Alzamendi et al. (2022)"
_CTJ = "cricothyroid joint, Titze & Hunter (2007) as used by Alzamendi et al. (2022)"
_COL = "arytenoid collision, as implemented with the model of Alzamendi et al. (2022)"


# The cricothyroid joint moves the thyroid cartilage, to which both folds are attached in front. Its strains ε_t and ε_r
# are shared unknowns, and L_0 turns them into its elongations, so L_0 is shared too. All else appears in the equations
# r0, r1, r2 of one arytenoid only (vfcore/kernels/posture_equations.py), adductor_strain_gain included.
_COMMON = {_CTJ: "there is one cricothyroid joint"}


def _q(default, unit, label, low, high, source, symbol, common=""):
    common = common or _COMMON.get(source, "")
    return quantity(default, unit, label, low, high, source=source, symbol=symbol, common=common)


@dataclass(frozen=True, slots=True, kw_only=True)
class JointConstants:
    """Geometry and stiffness of the two laryngeal joints, SI."""

    L_0_posture_m: float = _q(
        0.0173, "m", "resting fold length in the posturing equations", 5e-3, 3e-2,
        "length of the TA muscle, Titze & Hunter (2007); the vibrating fold of the paper has 15 mm", "L_0",
        common="it measures the elongation by the one cricothyroid joint",
    )  # fmt: skip
    adductor_strain_gain: float = _q(0.7, "1", "strain of LCA, IA and PCA per γ θ_a / length", 0, 2, _CAJ, "0.7")

    x_CAJ_m: float = _q(0.0101, "m", "centre of the cricoarytenoid joint, lateral", 1e-3, 3e-2, _CAJ, "x_C")
    y_CAJ_m: float = _q(-0.0101, "m", "centre of the cricoarytenoid joint, anterior", -3e-2, -1e-3, _CAJ, "y_C")
    vocal_process_x_m: float = _q(0.004, "m", "cadaveric position of the vocal process, lateral", 0, 2e-2, _CAJ, "x̄_02")

    k_x_n_m: float = _q(60.0, "N/m", "lateral stiffness", 1, 1e4, _CAJ, "k_x")
    k_x_quadratic_m2: float = _q(2e5, "1/m²", "its quadratic growth", 0, 1e8, _CAJ, "k_x,2")
    k_x_quartic_m4: float = _q(2e13, "1/m⁴", "its quartic growth beyond the limit", 0, 1e16, _CAJ, "k_x,4")
    k_x_limit_m: float = _q(3e-3, "m", "displacement where the quartic starts", 0, 2e-2, _CAJ, "ξ_lim")
    k_y_n_m: float = _q(200.0, "N/m", "anterior–posterior stiffness", 1, 1e4, _CAJ, "k_y")
    k_y_quadratic_m2: float = _q(2e5, "1/m²", "its quadratic growth", 0, 1e8, _CAJ, "k_y,2")
    k_y_quartic_m4: float = _q(2e13, "1/m⁴", "its quartic growth beyond the limit", 0, 1e16, _CAJ, "k_y,4")
    k_y_limit_m: float = _q(3e-3, "m", "displacement where the quartic starts", 0, 2e-2, _CAJ, "ψ_lim")
    kappa_n_m_rad: float = _q(0.005, "N·m/rad", "rotational stiffness of the arytenoid", 1e-5, 1, _CAJ, "κ")
    kappa_quadratic_rad2: float = _q(10.0, "1/rad²", "its quadratic growth", 0, 1e4, _CAJ, "κ_2")
    kappa_quartic_rad4: float = _q(1e4, "1/rad⁴", "its quartic growth beyond the limit", 0, 1e7, _CAJ, "κ_4")
    kappa_limit_rad: float = _q(0.3, "rad", "rotation where the quartic starts", 0, 1.5, _CAJ, "θ_lim")
    collision_ratio: float = _q(20.0, "1", "collision stiffness κ_col R/κ", 0, 1e3, _COL, "κ_col R/κ")
    collision_cubic_rad2: float = _q(500.0, "1/rad²", "cubic growth of the collision", 0, 1e5, _COL, "κ_col,3")

    cos_phi: float = _q(0.76, "1", "cosine of the CT muscle's angle to the fold", 0.1, 1, _CTJ, "cos φ")
    h_TA_m: float = _q(0.0161, "m", "arm of the fold about the cricothyroid joint", 3e-3, 5e-2, _CTJ, "h")
    w_CT_m: float = _q(0.0111, "m", "arm of the CT muscle about the cricothyroid joint", 1e-3, 5e-2, _CTJ, "w")
    k_t_n_m: float = _q(500.0, "N/m", "translational stiffness", 1, 1e5, _CTJ, "k_t")
    k_t_rotation_rad: float = _q(30 / math.pi, "1/rad", "its growth with rotation", 0, 1e3, _CTJ, "k_t,r")
    k_t_quadratic_m2: float = _q(1e6, "1/m²", "its quadratic growth", 0, 1e9, _CTJ, "k_t,2")
    k_t_quartic_m4: float = _q(2e14, "1/m⁴", "its quartic growth beyond the limit", 0, 1e17, _CTJ, "k_t,4")
    k_t_limit_m: float = _q(1.5e-3, "m", "translation where the quartic starts", 0, 2e-2, _CTJ, "d_t,lim")
    k_r_n_m_rad: float = _q(0.05, "N·m/rad", "rotational stiffness", 1e-4, 10, _CTJ, "k_r")
    k_r_translation_m: float = _q(1500.0, "1/m", "its growth with translation", 0, 1e5, _CTJ, "k_r,t")
    k_r_quadratic_rad2: float = _q(40.0, "1/rad²", "its quadratic growth", 0, 1e4, _CTJ, "k_r,2")
    k_r_quartic_rad4: float = _q(2e5, "1/rad⁴", "its quartic growth beyond the limit", 0, 1e8, _CTJ, "k_r,4")
    k_r_limit_rad: float = _q(0.2, "rad", "rotation where the quartic starts", 0, 1.5, _CTJ, "a_lim")
