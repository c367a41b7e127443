"""Named variants of the model: which equations, which posturing, and which constants differ from the paper's.

``human`` and ``human_female`` change constants only. The values of ``human`` come from the calibration study of
vocalis_norms (docs/model.md, section 12): among constants within measured ranges, those that bring the voice of the
modal posture nearest to published norms of men. ``human_female`` is scaled from it and calibrated against nothing.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

from vfcore.constants import FoldConstants


@dataclass(frozen=True, slots=True)
class Change:
    """One constant that a variant replaces: its name in FoldConstants, the value, and the reason for it."""

    name: str
    value: float
    why: str


@dataclass(frozen=True, slots=True)
class ModelVariant:
    """The named choices that a variant stands for.

    ``changes``: constants that differ from the paper's. ``meant_with``: the source–tract coupling it was made for; a
    request chooses its own. ``airway_scale``: all lengths and diameters of both airways
    over those of the published male ones.
    """

    posture_set: str
    coupling_gradient: str
    shear: str
    help: str
    changes: tuple[Change, ...] = ()
    meant_with: str = "one_way"
    airway_scale: float = 1.0

    @property
    def overrides(self) -> Mapping[str, float]:
        """The changed constants by name."""
        return {change.name: change.value for change in self.changes}

    def constants(self, **overrides: float) -> FoldConstants:
        """The fold's constants of this variant, some of them replaced. ParameterError for a value out of range."""
        return FoldConstants(**{**self.overrides, **overrides}) if overrides else _unaltered(self.changes)


@cache
def _unaltered(changes: tuple[Change, ...]) -> FoldConstants:
    return FoldConstants(**{change.name: change.value for change in changes})


_HUMAN = (
    Change(
        "C_coup_pa_s_m", 900.0,
        "Damping ratio of the lowest mode of the mucosa in vacuo, at the modal posture: 0.29; the paper's 10 Pa·s/m "
        "give 0.01. Ratios of 0.1 to 0.4 are used after measurements on folds and larynges (Ishizaka & Flanagan 1972; "
        "Titze & Story 2002).",
    ),
    Change(
        "A_muc_0_m2", 9e-6,
        "Depth of the mucosa 1.8 mm instead of 1 mm: the mass that moves with the surface. Body–cover models of a "
        "man's fold use a cover of 2 mm (Titze & Story 2002).",
    ),
    Change(
        "K_coup_min_pa_m", 7e4,
        "1.4 times the paper's: keeps f_o of the heavier mucosa, and the small opening. Not measured directly.",
    ),
    Change("K_coup_max_pa_m", 7e5, "1.4 times the paper's, as the soft edge."),
    Change(
        "K_col_pa_m", 1.8e6,
        "Stiffer contact, so that the folds pass through each other less. Not measured directly; held by the norms "
        "of contact pressure and f_o.",
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
    )


VARIANTS = {
    "paper": ModelVariant(
        "serry2026", "inferior_stiff", "kelvin_voigt",
        "The paper's numbers: Kelvin–Voigt membrane, coupling stiffest at the inferior edge.",
    ),
    "text_literal": ModelVariant(
        "serry2026", "superior_stiff", "rotation",
        "The paper's text to the letter: rotation equation, coupling stiffest at the superior edge.",
    ),
    "human": ModelVariant(
        "serry2026", "inferior_stiff", "kelvin_voigt",
        "Adult man: the paper's equations, five constants set so that flow, area and level are of human size. "
        "Meant with coupling two_way.",
        _HUMAN, "two_way",
    ),
    "human_female": ModelVariant(
        "serry2026", "inferior_stiff", "kelvin_voigt",
        "Adult woman, an extrapolation: the human variant with folds and airways scaled by published ratios; "
        "posturing and tissue are a man's, and no measurement was fitted.",
        _scaled(_HUMAN), "two_way", 1.0 / AIRWAY_RATIO,
    ),
}  # fmt: skip
