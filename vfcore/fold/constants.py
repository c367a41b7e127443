"""The constants of the vocal fold, as the paper's tables print them.

Default subject: the adult male larynx of the paper. Each field has its source, and can be overridden by its name. The
posturing tables live in vfcore/spec/posture_sets.py.
"""

from dataclasses import dataclass

from vfcore.spec.fields import PAPER, quantity, validate

_DIM = f"{PAPER}, table of resting dimensions and densities"
_CON = f"{PAPER}, table of constitutive parameters"
_AIR = f"{PAPER}, table of aerodynamic parameters"
_ONE_STREAM = "one stream of air passes between the folds"
_MEC = f"{PAPER}, table of stiffness and damping parameters"


@dataclass(frozen=True, slots=True)
class FoldConstants:
    """Geometry, tissue, air and contact of one vocal fold; SI units throughout."""

    L_0_m: float = quantity(1.5e-2, "m", "resting length", 5e-3, 3e-2, source=_DIM, symbol="L_0")
    b_0_m: float = quantity(5e-3, "m", "resting inferior–superior thickness", 1e-3, 1.5e-2, source=_DIM, symbol="b_0")
    A_muc_0_m2: float = quantity(5e-6, "m²", "resting section of the mucosa", 5e-7, 5e-5, source=_DIM, symbol="A_muc,0")
    A_lig_0_m2: float = quantity(
        6.1e-6, "m²", "resting section of the ligament", 5e-7, 5e-5, source=_DIM, symbol="A_lig,0"
    )
    A_ta_0_m2: float = quantity(
        4.09e-5, "m²", "resting section of the TA muscle", 4e-6, 4e-4, source=_DIM, symbol="A_ta,0"
    )
    rho_muc_kg_m3: float = quantity(
        1000.0, "kg/m³", "density of the mucosa", 500, 3000, source=_DIM, symbol="ρ_muc",
        help="far beyond that of tissue too: a mass asymmetry of left and right, as in Steinecke & Herzel (1995)",
    )  # fmt: skip
    rho_lig_kg_m3: float = quantity(1030.0, "kg/m³", "density of the ligament", 500, 2000, source=_DIM, symbol="ρ_lig")
    rho_ta_kg_m3: float = quantity(1050.0, "kg/m³", "density of the TA muscle", 500, 2000, source=_DIM, symbol="ρ_ta")

    sigma_1_muc_pa: float = quantity(1000.0, "Pa", "mucosa, linear stress", 0, 1e6, source=_CON, symbol="σ_1,muc")
    sigma_1_lig_pa: float = quantity(500.0, "Pa", "ligament, linear stress", 0, 1e6, source=_CON, symbol="σ_1,lig")
    sigma_1_ta_pa: float = quantity(2000.0, "Pa", "TA, linear stress", 0, 1e6, source=_CON, symbol="σ_1,ta")
    epsilon_1_muc: float = quantity(
        -0.5, "1", "mucosa, strain of zero stress", -1, -0.05, source=_CON, symbol="ε_1,muc"
    )
    epsilon_1_lig: float = quantity(
        -0.5, "1", "ligament, strain of zero stress", -1, -0.05, source=_CON, symbol="ε_1,lig"
    )
    epsilon_1_ta: float = quantity(-0.5, "1", "TA, strain of zero stress", -1, -0.05, source=_CON, symbol="ε_1,ta")
    sigma_2_muc_pa: float = quantity(1000.0, "Pa", "mucosa, exponential stress", 0, 1e6, source=_CON, symbol="σ_2,muc")
    sigma_2_lig_pa: float = quantity(
        1000.0, "Pa", "ligament, exponential stress", 0, 1e6, source=_CON, symbol="σ_2,lig"
    )
    sigma_2_ta_pa: float = quantity(1000.0, "Pa", "TA, exponential stress", 0, 1e6, source=_CON, symbol="σ_2,ta")
    epsilon_2_muc: float = quantity(
        -0.3, "1", "mucosa, strain where the exponential starts", -1, 1, source=_CON, symbol="ε_2,muc"
    )
    epsilon_2_lig: float = quantity(
        -0.3, "1", "ligament, strain where the exponential starts", -1, 1, source=_CON, symbol="ε_2,lig"
    )
    epsilon_2_ta: float = quantity(
        -0.05, "1", "TA, strain where the exponential starts", -1, 1, source=_CON, symbol="ε_2,ta"
    )
    alpha_1_muc: float = quantity(6.0, "1", "mucosa, exponential rate", 0, 40, source=_CON, symbol="α_1,muc")
    alpha_1_lig: float = quantity(7.0, "1", "ligament, exponential rate", 0, 40, source=_CON, symbol="α_1,lig")
    alpha_1_ta: float = quantity(9.0, "1", "TA, exponential rate", 0, 40, source=_CON, symbol="α_1,ta")
    sigma_a_max_ta_pa: float = quantity(
        1e5, "Pa", "TA, largest active stress", 0, 1e6, source=_CON, symbol="σ_a,max,ta"
    )
    epsilon_m_ta: float = quantity(0.3, "1", "TA, strain of largest active stress", -1, 1, source=_CON, symbol="ε_m,ta")
    alpha_2_ta: float = quantity(1.0, "1", "TA, width of the active stress", 0, 20, source=_CON, symbol="α_2,ta")

    alpha_s: float = quantity(
        1.3, "1", "flow separation ratio", 1.0, 2.5, source=_AIR, symbol="α_s", common=_ONE_STREAM
    )
    rho_a_kg_m3: float = quantity(
        1.14, "kg/m³", "density of air", 0.1, 10, source=_AIR, symbol="ρ_a", common=_ONE_STREAM
    )
    mu_a_pa_s: float = quantity(
        1.8e-5, "Pa·s", "viscosity of air", 0, 1e-3, source=_AIR, symbol="μ_a", common=_ONE_STREAM
    )
    c_a_m_s: float = quantity(350.0, "m/s", "speed of sound", 100, 1500, source=_AIR, symbol="c_a", common=_ONE_STREAM)

    K_coup_min_pa_m: float = quantity(
        5e4, "Pa/m", "coupling stiffness, soft edge", 0, 1e8, source=_MEC, symbol="K_coup,min"
    )
    K_coup_max_pa_m: float = quantity(
        5e5, "Pa/m", "coupling stiffness, stiff edge", 0, 1e8, source=_MEC, symbol="K_coup,max"
    )
    C_coup_pa_s_m: float = quantity(10.0, "Pa·s/m", "coupling damping", 0, 1e5, source=_MEC, symbol="C_coup")
    K_foun_pa: float = quantity(100.0, "Pa", "foundation stiffness", 0, 1e7, source=_MEC, symbol="K_foun")
    C_foun_pa_s: float = quantity(1.0, "Pa·s", "foundation damping", 0, 1e4, source=_MEC, symbol="C_foun")
    K_col_pa_m: float = quantity(
        1e6, "Pa/m", "contact stiffness", 1e4, 1e9, source=_MEC + " (printed in Pa)", symbol="K_col"
    )
    C_col_pa_s_m: float = quantity(
        100.0, "Pa·s/m", "contact damping", 0, 1e5, source=_MEC + " (printed in Pa·s)", symbol="C_col"
    )
    G_m_pa: float = quantity(100.0, "Pa", "shear stiffness of the mucosa", 0, 1e6, source=_MEC, symbol="G_m")
    eta_m_pa_s: float = quantity(1.0, "Pa·s", "shear viscosity of the mucosa", 0, 1e3, source=_MEC, symbol="η_m")
    K_r_a_n_m: float = quantity(2e-2, "N·m", "anterior rotational stiffness", 0, 10, source=_MEC, symbol="K_r,a")
    K_r_p_n_m: float = quantity(1e-2, "N·m", "posterior rotational stiffness", 0, 10, source=_MEC, symbol="K_r,p")

    rest_angle_rad: float = quantity(
        0.254,
        "rad",
        "rest angle at the anterior commissure",
        -0.5,
        1.0,
        source="not printed in the paper; an earlier version of the model used 0.2540 rad, "
        "close to the half-angle at zero activation (0.239 rad)",
        symbol="θ_0",
    )

    def __post_init__(self):
        validate(self, "constants.")
