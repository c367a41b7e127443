"""Named variants of the model: which equations, which posturing, and which constants differ from the paper's.

``human`` and ``human_female`` change constants, the coupling and the stretch only. The values of ``human`` come from
the calibration study of vocalis.studies.norms, which used a constant tension: with it they meet thirteen of fifteen
published norms of men. With finite stretch, the default of the variant, they meet eleven, and four of the paper's maps
are reproduced worse than with its own constants (docs/human.md). ``human_female`` is scaled from ``human`` and is not
calibrated.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from vfcore.fold.constants import FoldConstants


@dataclass(frozen=True, slots=True)
class Change:
    """One constant of the larynx that a variant replaces: name, value and reason."""

    name: str
    value: float
    why: str


@dataclass(frozen=True, slots=True)
class ModelVariant:
    """One variant: a posturing set, equations, and the constants of the larynx that differ from the paper's.

    ``coupling``, ``stretch``: source–tract coupling and membrane tension it was made for, the defaults of a request
    with this variant.
    """

    posture_set: str
    coupling_gradient: str
    shear: str
    coupling: str
    stretch: str
    help: str
    changes: tuple[Change, ...] = ()

    @property
    def overrides(self) -> Mapping[str, float]:
        """The changed constants by name."""
        return {change.name: change.value for change in self.changes}


_SHEAR = (
    "Measured in the superficial lamina propria, shear stiffness and viscosity differ tenfold between people, and the "
    "viscosity falls with frequency (Chan & Titze 1999)."
)
_HUMAN = (
    Change(
        "C_coup_pa_s_m", 36.0,
        "3.6 times the paper's value, which lets the opening grow beyond any larynx. Not measured directly; with the "
        "shear viscosity it sets the damping ratios of the mucosa; models use 0.1 to 0.4, after measurements on folds "
        "and larynges (Ishizaka & Flanagan 1972; Titze & Story 2002).",
    ),
    Change(
        "A_muc_0_m2", 7.2e-6,
        "Depth of the mucosa 1.44 mm instead of 1 mm: the mass that moves with the surface. Body–cover models of a "
        "man's fold use a cover of 2 mm (Titze & Story 2002).",
    ),
    Change(
        "K_coup_min_pa_m", 9.6e4,
        "Nearly twice the paper's value, which lets 1 kPa move the soft edge by 20 mm; now 10 mm. Not measured "
        "directly; constrained by the norms of area, flow and f_o.",
    ),
    Change(
        "K_coup_max_pa_m", 1.1e6,
        "2.2 times the paper's value. A layer of 1.4 mm with a modulus of 1 kPa across the fold (Alipour & Vigmostad "
        "2012) would have 6.9e5 Pa/m, between the values of the two edges. Not measured directly.",
    ),
    Change(
        "K_col_pa_m", 1.2e6,
        "A little stiffer than the paper's, so that the folds interpenetrate less; the stiffer the contact, "
        "the more f_o rises with medial compression, above all by TA. Constrained by the norm of contact pressure.",
    ),
    Change("C_col_pa_s_m", 110.0, "Scaled with the contact stiffness: their ratio, 0.09 ms, is nearly the paper's."),
    Change("G_m_pa", 25.0, f"{_SHEAR} Constrained by the paper's trends."),
    Change("eta_m_pa_s", 0.35, f"{_SHEAR} Constrained by the paper's trends."),
    Change(
        "sigma_2_muc_pa", 1600.0,
        "Its slope at rest length is 50 kPa instead of 32; measurements in the lamina propria give about 30 kPa at low "
        "strain and 10 to 15 times as much at high strain (Alipour & Vigmostad 2012). The more f_o depends on "
        "the length, the more TA, which shortens the folds, lowers it.",
    ),
    Change(
        "K_r_a_n_m", 0.025,
        "A quarter more than the paper's. Not measured. The stiffer the anterior attachment, the less TA bulges "
        "the folds against each other, and the less contact raises f_o.",
    ),
)  # fmt: skip
LENGTH_RATIO, SIZE_RATIO, AIRWAY_RATIO = 1.6, 1.2, 1.2  # men over women, Titze (1989b); airways: Fitch & Giedd (1999)


def _scaled(human: tuple[Change, ...]) -> tuple[Change, ...]:
    base = FoldConstants(**{change.name: change.value for change in human})
    area = "thickness and depth over 1.2 each: men's folds over women's, Titze (1989b)"
    return (
        *(change for change in human if change.name != "A_muc_0_m2"),
        Change("L_0_m", base.L_0_m / LENGTH_RATIO, "membranous length over 1.6, Titze (1989b)"),
        Change("b_0_m", base.b_0_m / SIZE_RATIO, "thickness over 1.2, Titze (1989b)"),
        Change("A_muc_0_m2", base.A_muc_0_m2 / SIZE_RATIO**2, area),
        Change("A_lig_0_m2", base.A_lig_0_m2 / SIZE_RATIO**2, area),
        Change("A_ta_0_m2", base.A_ta_0_m2 / SIZE_RATIO**2, area),
        Change("airway_scale", 1.0 / AIRWAY_RATIO, "lengths and diameters over 1.2, Fitch & Giedd (1999)"),
    )


VARIANTS = {
    "paper": ModelVariant(
        "serry2026", "inferior_stiff", "kelvin_voigt", "one_way", "linear",
        "The paper's numbers: Kelvin–Voigt membrane, coupling stiffest at the inferior edge.",
    ),
    "text_literal": ModelVariant(
        "serry2026", "superior_stiff", "rotation", "one_way", "linear",
        "The paper's text to the letter: rotation equation, coupling stiffest at the superior edge.",
    ),
    "human": ModelVariant(
        "serry2026", "inferior_stiff", "kelvin_voigt", "two_way", "finite",
        "Adult man: ten constants set with constant tension for flow, pitch and level of human size; with finite "
        "stretch they meet 11 of 15 norms of men. Defaults: coupling two_way, stretch finite.",
        _HUMAN,
    ),
    "human_female": ModelVariant(
        "serry2026", "inferior_stiff", "kelvin_voigt", "two_way", "finite",
        "Adult woman, an extrapolation: the human variant with folds and airways scaled by published ratios; "
        "posturing and tissue are a man's, and no measurement was fitted.",
        _scaled(_HUMAN),
    ),
}  # fmt: skip
