"""From strain and TA activation to the coefficients of the beam–membrane equations.

The paper, "Model development", with its symbols. Index muc, lig, ta; subscript 0 resting;
λ = 1 + ε̄. Incompressible layers: d_i = d_i,0/√λ, b = b_0/√λ, A_i = A_i,0/λ.

    T̃_m = d_muc λ^{3/2} σ_muc,  σ_muc = λ σ̄_muc(ε̄)          membrane tension, N/m
    G̃_m = d_muc G_m/λ,  η̃_m = d_muc η_m/λ                   membrane shear, N/m and N·s/m
    ρ_s = ρ_muc d_muc,  J_m = λ ρ_muc d_muc²/12
    N_b = λ Σ A_i σ̄_i(ε̄),  Ñ_b = λ^{3/2} N_b                 beam tension, N   (i = lig, ta)
    μ_c = λ² Σ E_i (I_i + (r_c − r_i) A_i α_i),  μ̃_c = λ^{3/2} μ_c   bending stiffness, N·m²
    M̄_c = λ Σ (r_c − r_i) A_i σ̄_i(ε̄),  r_c = r_lig           prestress moment, N·m
    ρ_l = Σ ρ_i A_i

α_lig and α_ta are the text's form, 1/(2(1 + ratio)); see docs/model.md.
"""

from dataclasses import dataclass

from vfcore.constants import FoldConstants
from vfcore.errors import ParameterError
from vfcore.tissue.constitutive import active, passive


@dataclass(frozen=True, slots=True)
class Coefficients:
    """Prestrained geometry and coefficients of one fold (SI units, the paper's symbols)."""

    stretch_ratio: float  # λ
    length_m: float  # L
    thickness_m: float  # b
    membrane_tension_n_m: float  # T̃_m
    membrane_shear_n_m: float  # G̃_m
    membrane_shear_viscosity_n_s_m: float  # η̃_m
    membrane_density_kg_m2: float  # ρ_s
    rotation_inertia_kg_m: float  # J_m
    beam_tension_n: float  # Ñ_b
    bending_stiffness_n_m2: float  # μ̃_c
    prestress_moment_n_m: float  # M̄_c
    beam_density_kg_m: float  # ρ_l
    mucosa_depth_m: float  # d_muc
    sigma_muc_pa: float  # σ̄_muc, engineering
    sigma_lig_pa: float
    sigma_ta_pa: float
    E_muc_pa: float
    E_lig_pa: float
    E_ta_pa: float


def coefficients(strain: float, a_ta: float, c: FoldConstants) -> Coefficients:
    """Coefficients at nominal strain ε̄ and TA activation.

    Raises ParameterError where the prestrained fold has no stiffness left (the equations
    then mean nothing): membrane tension, axial or bending stiffness of the beam not above 0.
    """
    lam = 1.0 + strain
    root = lam**0.5
    b = c.b_0_m / root
    d_muc, d_lig, d_ta = (area / c.b_0_m / root for area in (c.A_muc_0_m2, c.A_lig_0_m2, c.A_ta_0_m2))
    A_lig, A_ta = c.A_lig_0_m2 / lam, c.A_ta_0_m2 / lam

    muc = passive(strain, c.sigma_1_muc_pa, c.epsilon_1_muc, c.sigma_2_muc_pa, c.epsilon_2_muc, c.alpha_1_muc)
    lig = passive(strain, c.sigma_1_lig_pa, c.epsilon_1_lig, c.sigma_2_lig_pa, c.epsilon_2_lig, c.alpha_1_lig)
    ta_passive = passive(strain, c.sigma_1_ta_pa, c.epsilon_1_ta, c.sigma_2_ta_pa, c.epsilon_2_ta, c.alpha_1_ta)
    ta_active = active(strain, a_ta, c.sigma_a_max_ta_pa, c.alpha_2_ta, c.epsilon_m_ta)
    sigma_ta, E_ta = ta_passive.sigma_pa + ta_active.sigma_pa, ta_passive.slope_pa + ta_active.slope_pa

    depth = d_ta + d_lig
    EA_lig, EA_ta = lig.slope_pa * A_lig, E_ta * A_ta
    _refuse_slack("the beam's axial stiffness in N", EA_lig + EA_ta, strain)
    alpha_lig = -depth * EA_ta / (2 * (EA_lig + EA_ta))
    alpha_ta = depth * EA_lig / (2 * (EA_lig + EA_ta))
    r_ta, r_lig = d_ta / 2, d_ta + d_lig / 2
    r_c = r_lig
    mu_c = lam**2 * (
        lig.slope_pa * (b * d_lig**3 / 12 + (r_c - r_lig) * A_lig * alpha_lig)
        + E_ta * (b * d_ta**3 / 12 + (r_c - r_ta) * A_ta * alpha_ta)
    )
    N_b = lam * (A_lig * lig.sigma_pa + A_ta * sigma_ta)
    M_c = lam * ((r_c - r_lig) * A_lig * lig.sigma_pa + (r_c - r_ta) * A_ta * sigma_ta)

    found = Coefficients(
        stretch_ratio=lam,
        length_m=lam * c.L_0_m,
        thickness_m=b,
        membrane_tension_n_m=d_muc * lam**1.5 * lam * muc.sigma_pa,
        membrane_shear_n_m=d_muc / lam * c.G_m_pa,
        membrane_shear_viscosity_n_s_m=d_muc / lam * c.eta_m_pa_s,
        membrane_density_kg_m2=c.rho_muc_kg_m3 * d_muc,
        rotation_inertia_kg_m=lam * c.rho_muc_kg_m3 * d_muc**2 / 12,
        beam_tension_n=lam**1.5 * N_b,
        bending_stiffness_n_m2=lam**1.5 * mu_c,
        prestress_moment_n_m=M_c,
        beam_density_kg_m=c.rho_lig_kg_m3 * A_lig + c.rho_ta_kg_m3 * A_ta,
        mucosa_depth_m=d_muc,
        sigma_muc_pa=muc.sigma_pa,
        sigma_lig_pa=lig.sigma_pa,
        sigma_ta_pa=sigma_ta,
        E_muc_pa=muc.slope_pa,
        E_lig_pa=lig.slope_pa,
        E_ta_pa=E_ta,
    )
    for name in ("membrane_tension_n_m", "bending_stiffness_n_m2"):
        _refuse_slack(name, getattr(found, name), strain)
    return found


def _refuse_slack(name: str, value: float, strain: float) -> None:
    if not value > 0:
        raise ParameterError(
            "constants",
            f"{name} = {value:.3g} at strain {strain:.3f}: the fold has no stiffness left",
            "constants and postures that keep it positive",
        )
