"""One force of the posturing models: a muscle, or a passive tissue without active stress."""

from dataclasses import MISSING, dataclass

from vfcore.spec.fields import quantity

_GEOMETRY = "Titze & Hunter (2007), as used by Alzamendi et al. (2022)"
_STRESS = "the source of the set"


@dataclass(frozen=True, slots=True)
class Muscle:
    """One force of the posturing model: F = A (σ_passive(ε) + a σ_max max(0, 1 − b (ε − ε_m)²)).

    σ_passive = −(σ_0/ε_1)(ε − ε_1), plus σ_2 (e^{B(ε − ε_2)} − 1 − B (ε − ε_2)) above ε_2; 0 below ε_1.
    The ligament and the mucosa are rows with σ_max = 0. Validated by ``PosturingConstants``.
    """

    rest_length_m: float = quantity(MISSING, "m", "resting length", 3e-3, 5e-2, source=_GEOMETRY, symbol="L_0,i")
    cross_section_m2: float = quantity(MISSING, "m²", "section", 1e-7, 1e-3, source=_GEOMETRY, symbol="A_i")
    strain_at_max_active_stress: float = quantity(
        MISSING, "1", "strain of largest active stress", -1, 2, source=_GEOMETRY, symbol="ε_m,i"
    )
    active_width_b: float = quantity(
        MISSING, "1", "width coefficient of the active stress", 0, 20, source=_GEOMETRY, symbol="b_i"
    )
    alpha: float = quantity(MISSING, "1", "direction cosine, lateral positive", -1, 1, source=_GEOMETRY, symbol="α_i")
    beta: float = quantity(MISSING, "1", "direction cosine, anterior positive", -1, 1, source=_GEOMETRY, symbol="β_i")
    gamma_m: float = quantity(
        MISSING, "m", "moment arm about the cricoarytenoid joint", -2e-2, 2e-2, source=_GEOMETRY, symbol="γ_i"
    )
    sigma_0_pa: float = quantity(MISSING, "Pa", "linear passive stress", 0, 1e6, source=_STRESS, symbol="σ_0,i")
    sigma_2_pa: float = quantity(MISSING, "Pa", "exponential passive stress", 0, 1e6, source=_STRESS, symbol="σ_2,i")
    epsilon_1: float = quantity(
        MISSING, "1", "strain of zero passive stress", -1, -0.05, source=_STRESS, symbol="ε_1,i"
    )
    epsilon_2: float = quantity(
        MISSING, "1", "strain where the exponential starts", -1, 1, source=_STRESS, symbol="ε_2,i"
    )
    exponential_B: float = quantity(MISSING, "1", "exponential rate", 0, 40, source=_STRESS, symbol="B_i")
    sigma_max_active_pa: float = quantity(
        MISSING, "Pa", "largest active stress", 0, 1e6, source=_STRESS, symbol="σ_max,i"
    )
