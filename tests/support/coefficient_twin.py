"""Twin of the prestrained coefficients, written from the text of the paper, without vfcore.larynx.tissue.

Source: Serry, Zañartu & Peterson (2026), "Model development". Tangent moduli come from
complex-step differentiation of the stress, not from an analytical derivative.
"""

import cmath
from dataclasses import dataclass

from vfcore.fold.constants import FoldConstants

COMPLEX_STEP = 1e-30


@dataclass(frozen=True)
class TwinCoefficients:
    """Coefficients of the coupled equations; SI units, the paper's symbols.

    ``sigma_*`` (Pa) are engineering stresses, ``E_*`` (Pa) their tangent moduli at the nominal
    strain. A trailing ``_tilde`` marks the paper's tilde.
    """

    lam: float  # λ, 1
    L: float  # m
    b: float  # m
    d_muc: float  # m
    d_lig: float  # m
    d_ta: float  # m
    A_muc: float  # m²
    A_lig: float  # m²
    A_ta: float  # m²
    sigma_muc: float
    sigma_lig: float
    sigma_ta: float
    E_muc: float
    E_lig: float
    E_ta: float
    T_m_tilde: float  # N/m
    G_m_tilde: float  # N/m
    eta_m_tilde: float  # N·s/m
    J_m: float  # kg/m
    rho_s: float  # kg/m²
    rho_l: float  # kg/m
    N_b: float  # N
    N_b_tilde: float  # N
    alpha_lig: float  # m
    alpha_ta: float  # m
    mu_c: float  # N·m²
    mu_c_tilde: float  # N·m²
    M_bar: float  # N·m


def passive_stress(constants: FoldConstants, layer: str, strain):
    """Passive engineering stress of ``layer`` ("muc", "lig" or "ta") in Pa; strain may be complex."""
    sigma_1 = getattr(constants, f"sigma_1_{layer}_pa")
    sigma_2 = getattr(constants, f"sigma_2_{layer}_pa")
    epsilon_1 = getattr(constants, f"epsilon_1_{layer}")
    epsilon_2 = getattr(constants, f"epsilon_2_{layer}")
    alpha_1 = getattr(constants, f"alpha_1_{layer}")
    stress = -sigma_1 / epsilon_1 * (strain - epsilon_1)
    if strain.real > epsilon_2:
        stretch = alpha_1 * (strain - epsilon_2)
        stress += sigma_2 * (cmath.exp(stretch) - 1 - stretch)
    return stress


def active_stress(constants: FoldConstants, a_ta: float, strain):
    """Active engineering stress of the TA muscle, Pa; strain may be complex."""
    hump = 1 - constants.alpha_2_ta * (strain - constants.epsilon_m_ta) ** 2
    return a_ta * constants.sigma_a_max_ta_pa * (hump if hump.real > 0 else 0 * hump)


def layer_stress(constants: FoldConstants, layer: str, a_ta: float, strain):
    """Total engineering stress of a layer, Pa; strain may be complex."""
    stress = passive_stress(constants, layer, strain)
    return stress + active_stress(constants, a_ta, strain) if layer == "ta" else stress


def coefficients(constants: FoldConstants, strain: float, a_ta: float) -> TwinCoefficients:
    """Every prestrained coefficient at nominal strain ``strain`` and TA activation ``a_ta``."""
    c = constants
    lam = 1 + strain
    rest_area = {"muc": c.A_muc_0_m2, "lig": c.A_lig_0_m2, "ta": c.A_ta_0_m2}
    A = {layer: area / lam for layer, area in rest_area.items()}
    d = {layer: area / c.b_0_m / lam**0.5 for layer, area in rest_area.items()}
    b = c.b_0_m / lam**0.5
    probe = strain + 1j * COMPLEX_STEP
    sigma = {layer: layer_stress(c, layer, a_ta, probe).real for layer in A}
    E = {layer: layer_stress(c, layer, a_ta, probe).imag / COMPLEX_STEP for layer in A}

    # σ_muc of the tension is the prestrained stress λ·σ̄, not the engineering one.
    T_m_tilde = d["muc"] * lam**1.5 * (lam * sigma["muc"])

    # Beam: ligament on TA, moments about the ligament's centre.
    span = d["ta"] + d["lig"]
    alpha = {
        "lig": -span / (2 * (1 + E["lig"] * A["lig"] / (E["ta"] * A["ta"]))),
        "ta": span / (2 * (1 + E["ta"] * A["ta"] / (E["lig"] * A["lig"]))),
    }
    r = {"ta": d["ta"] / 2, "lig": d["ta"] + d["lig"] / 2}
    N_b = mu_c = M_bar = 0.0
    for layer in ("lig", "ta"):
        arm = r["lig"] - r[layer]
        second_moment = b * d[layer] ** 3 / 12
        N_b += lam * A[layer] * sigma[layer]
        mu_c += lam**2 * E[layer] * (second_moment + arm * A[layer] * alpha[layer])
        M_bar += lam * arm * A[layer] * sigma[layer]

    return TwinCoefficients(
        lam=lam,
        L=lam * c.L_0_m,
        b=b,
        **{f"d_{layer}": d[layer] for layer in A},
        **{f"A_{layer}": A[layer] for layer in A},
        **{f"sigma_{layer}": sigma[layer] for layer in A},
        **{f"E_{layer}": E[layer] for layer in A},
        T_m_tilde=T_m_tilde,
        G_m_tilde=d["muc"] / lam * c.G_m_pa,
        eta_m_tilde=d["muc"] / lam * c.eta_m_pa_s,
        J_m=lam * c.rho_muc_kg_m3 * d["muc"] ** 2 / 12,
        rho_s=c.rho_muc_kg_m3 * d["muc"],
        rho_l=c.rho_lig_kg_m3 * A["lig"] + c.rho_ta_kg_m3 * A["ta"],
        N_b=N_b,
        N_b_tilde=lam**1.5 * N_b,
        alpha_lig=alpha["lig"],
        alpha_ta=alpha["ta"],
        mu_c=mu_c,
        mu_c_tilde=lam**1.5 * mu_c,
        M_bar=M_bar,
    )
