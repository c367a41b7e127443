"""Published muscle and tissue constants of the posturing models, one row each.

Geometry (length, section, direction cosines, moment arm, active width) is common to the published
sets; the stress laws differ. Sources: Titze & Hunter (2007), JASA 121(4):2254–2260; Titze (2006),
The Myoelastic Aerodynamic Theory of Phonation; Palaparthi, Smith & Titze (2019), Appl. Sci. 9(21):4671;
Alzamendi et al. (2022), JASA 151(1):17–30; Serry, Zañartu & Peterson (2026).
"""

from dataclasses import MISSING, dataclass

from vfcore.spec.fields import quantity

_GEOMETRY = "Titze & Hunter (2007), as used by Alzamendi et al. (2022)"
_STRESS = "the source of the set"


@dataclass(frozen=True, slots=True)
class Muscle:
    """One force of the posturing model: F = A (σ_passive(ε) + a σ_max max(0, 1 − b (ε − ε_m)²)).

    σ_passive = −(σ_0/ε_1)(ε − ε_1), plus σ_2 (e^{B(ε − ε_2)} − 1 − B (ε − ε_2)) above ε_2; 0 below ε_1.
    The ligament and the mucosa are rows too, with σ_max = 0. Validated by ``PosturingConstants``.
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


# rest_length_m, cross_section_m2, strain_at_max_active_stress, active_width_b, alpha, beta, gamma_m
GEOMETRY = {
    "lca": (0.0144, 2.12e-5, 0.4, 2.37, -0.198, 0.886, 0.003915),
    "ia": (0.0093, 1.22e-5, 0.4, 1.25, -0.697, -0.644, -0.0033),
    "pca": (0.015, 3.44e-5, 0.4, 1.86, -0.1, -0.95, -0.00549),
    "ct": (0.0138, 7.38e-5, 0.0, 2.4, 0.0, 0.0, 0.0),
    "ta": (0.0173, 4.09e-5, 0.2, 1.07, 0.015, 0.99, 0.0008),
    "lig": (0.0173, 6.1e-6, 1.0, 1.0, 0.0, 0.0, 0.0),
    "muc": (0.0173, 5e-6, 1.0, 1.0, 0.0, 0.0, 0.0),
}

# sigma_0_pa, sigma_2_pa, epsilon_1, epsilon_2, exponential_B, sigma_max_active_pa
STRESS_LAWS = {
    "titze2006": {
        "lca": (3000.0, 59000.0, -0.5, 0.05, 4.0, 1e5),
        "ia": (2000.0, 30000.0, -0.5, 0.0, 3.5, 1e5),
        "pca": (5000.0, 55000.0, -0.5, 0.1, 5.3, 1e5),
        "ct": (2200.0, 5000.0, -0.5, -0.06, 7.0, 9e4),
        "ta": (1000.0, 1500.0, -0.5, -0.05, 6.5, 1.05e5),
        "lig": (1000.0, 1400.0, -0.5, 0.0, 17.0, 0.0),
        "muc": (1000.0, 9000.0, -0.5, -0.35, 4.4, 0.0),
    },
    "palaparthi2019": {
        "lca": (3000.0, 59000.0, -0.9, 0.05, 4.0, 1.4e5),
        "ia": (2000.0, 30000.0, -0.9, 0.0, 3.5, 1.4e5),
        "pca": (5000.0, 55000.0, -0.9, 0.1, 5.3, 1e5),
        "ct": (2200.0, 5000.0, -0.9, -0.06, 7.0, 4e5),
        "ta": (2000.0, 1500.0, -0.9, -0.5, 6.5, 1.8e5),
        "lig": (2000.0, 150.0, -0.9, -0.5, 12.8, 0.0),
        "muc": (200.0, 1500.0, -0.9, -0.2, 6.5, 0.0),
    },
    "alzamendi2020": {
        "lca": (3000.0, 59000.0, -0.5, -0.06, 4.0, 1e5),
        "ia": (2000.0, 30000.0, -0.5, -0.06, 3.5, 1e5),
        "pca": (5000.0, 55000.0, -0.5, -0.05, 5.3, 1e5),
        "ct": (2200.0, 5000.0, -0.5, 0.0, 7.0, 3e5),
        "ta": (1000.0, 1500.0, -0.5, -0.05, 6.5, 1.5e5),
        "lig": (500.0, 1400.0, -0.5, -0.3, 13.0, 0.0),
        "muc": (500.0, 20000.0, -0.5, -0.3, 4.4, 0.0),
    },
}  # fmt: skip
# The paper's own table for the three layers of the fold, the rest as in alzamendi2020.
STRESS_LAWS["serry2026"] = STRESS_LAWS["alzamendi2020"] | {
    "ta": (2000.0, 1000.0, -0.5, -0.05, 9.0, 1e5),
    "lig": (500.0, 1000.0, -0.5, -0.3, 7.0, 0.0),
    "muc": (1000.0, 1000.0, -0.5, -0.3, 6.0, 0.0),
}
# The paper prints ε_m,ta = 0.3 and α_2,ta = 1 for the vibrating fold; its posturing reportedly has 0.4 and 1.07.
GEOMETRY_CHANGES = {"serry2026": {"ta": (0.0173, 4.09e-5, 0.4, 1.07, 0.015, 0.99, 0.0008)}}


def muscle(set_name: str, key: str) -> Muscle:
    """The row ``key`` (lca, ia, pca, ct, ta, lig or muc) of a published set."""
    geometry = GEOMETRY_CHANGES.get(set_name, {}).get(key, GEOMETRY[key])
    return Muscle(*geometry, *STRESS_LAWS[set_name][key])
