"""Coefficients of the beam–membrane equations from strain and TA activation.

The paper, "Model development", with its symbols. Index muc, lig, ta; subscript 0 resting;
λ = 1 + ε̄. Incompressible layers: d_i = d_i,0/√λ, b = b_0/√λ, A_i = A_i,0/λ.

    T̃_m = d_muc λ^{3/2} σ_muc,  σ_muc = λ σ̄_muc(ε̄)          membrane tension, N/m
    G̃_m = d_muc G_m/λ,  η̃_m = d_muc η_m/λ                   membrane shear, N/m and N·s/m
    ρ_s = ρ_muc d_muc,  J_m = λ ρ_muc d_muc²/12
    N_b = λ Σ A_i σ̄_i(ε̄),  Ñ_b = λ^{3/2} N_b                 beam tension, N   (i = lig, ta)
    μ_c = λ² Σ E_i (I_i + (r_c − r_i) A_i α_i),  μ̃_c = λ^{3/2} μ_c   bending stiffness, N·m²
    M̄_c = λ Σ (r_c − r_i) A_i σ̄_i(ε̄),  r_c = r_lig           prestress moment, N·m
    ρ_l = Σ ρ_i A_i

α_lig and α_ta are the text's form, 1/(2(1 + ratio)); see docs/model/choices.md, row 4.
"""

from dataclasses import dataclass

from vfcore.errors import ParameterError
from vfcore.fold.constants import FoldConstants
from vfcore.larynx.tissue.prestrain import prestrained


@dataclass(frozen=True, slots=True)
class Coefficients:
    """Prestrained geometry and coefficients of one fold (SI units, the paper's symbols).

    In the order of ``vfcore.larynx.tissue.prestrain.prestrained``, which computes them.
    """

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

    Raises ParameterError if the prestrained fold has no stiffness left, that is, if membrane tension, axial or bending
    stiffness of the beam is not positive: the equations are meaningless then.
    """
    *numbers, axial_stiffness_n = prestrained(strain, a_ta, c)
    _refuse_slack("the beam's axial stiffness in N", axial_stiffness_n, strain)
    found = Coefficients(*numbers)
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
