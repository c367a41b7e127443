"""The choices that the paper leaves open, as changes of the request, one row for each alternative."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations
from typing import Any

from vfcore.runs.setup import prepare
from vfcore.spec.posture_sets import constant_names, posture_set
from vfcore.spec.request import flat
from vfcore.spec.simulation import PAPER_STEP_S, Simulation
from vocalis.studies.paper.run.gather import LEVEL, Prepare
from vocalis.studies.paper.study.fold import with_reported_alpha


@dataclass(frozen=True, slots=True)
class Choice:
    """One alternative. ``factor``: the open choice; ``takes``: the alternative; ``change``: its patch of the request.

    ``level``: the measure that is the level of a map. ``fold``: a function that makes the folds, if no request can.
    ``control``: a numerical setting that should change nothing; it is not paired.
    """

    factor: str
    takes: str
    change: Mapping[str, Any]
    level: str = LEVEL
    fold: Prepare = prepare
    control: bool = False

    @property
    def name(self) -> str:
        return f"{self.factor} {self.takes}".strip()


def _constant(factor: str, takes: str, **constants: float) -> Choice:
    return Choice(factor, takes, {"constants": constants})


def _tissues_of(name: str, *tissues: str) -> dict[str, float]:
    """The posturing constants of some tissues (``TA``, ``lig``, ``muc``) that differ from the default."""
    own, other = posture_set(Simulation().posturing.set_name), posture_set(name)
    names = (c for c in constant_names() if c.split("_")[0] in tissues and own.value(c) != other.value(c))
    return {c: other.value(c) for c in names}


def _tissue_mixes(name: str) -> Iterator[Choice]:
    """All mixes of the default's tissues with those of a published set, all else at the default."""
    tissues = ("TA", "lig", "muc")
    for count in (1, 2):
        for chosen in combinations(tissues, count):
            yield _constant("posturing tissue", f"{' and '.join(chosen)} of {name}", **_tissues_of(name, *chosen))


DEFAULT = Choice("default", "", {})
CHOICES = (
    _constant("L_0 of the posturing", "15 mm", L_0_posture_m=0.015),
    _constant("θ_0", "0.248 rad", rest_angle_rad=0.248),
    _constant("θ_0", "0.239 rad", rest_angle_rad=0.239),
    _constant("θ_0", "0.2 rad", rest_angle_rad=0.2),
    # The paper's table has these values for the vibrating TA; the posturing of serry2026 has 0.4 and 1.07.
    _constant("TA of the posturing", "ε_m 0.3, b 1", TA_strain_at_max_active_stress=0.3, TA_active_width_b=1.0),
    Choice("posturing set", "alzamendi2020", {"model": {"posture_set": "alzamendi2020"}}),
    Choice("posturing set", "titze2006", {"model": {"posture_set": "titze2006"}}),
    Choice("posturing set", "palaparthi2019", {"model": {"posture_set": "palaparthi2019"}}),
    *_tissue_mixes("alzamendi2020"),
    Choice("α in the bending stiffness", "1/(2 ratio + 1)", {}, fold=with_reported_alpha),
    # An interpolated separation point would be where finer rows put it, within half a spacing of the default rows.
    Choice("separation point", "read on 20 rows", {"run": {"ny": 20}}),
    Choice("coupling gradient", "superior_stiff", {"model": {"coupling_gradient": "superior_stiff"}}),
    Choice("shear", "rotation", {"model": {"shear": "rotation"}}),
    Choice("initial state", "static", {"run": {"start": "static"}}),
    Choice("initial state", "static, pressure rising over 0.1 s", {"run": {"start": "static", "pressure_rise_s": 0.1}}),
    Choice("initial state", "flat, pressure rising over 0.1 s", {"run": {"pressure_rise_s": 0.1}}),
    Choice("window", "last second of 2 s", {"run": {"duration_s": 2.0}}),
    Choice("level", "at 30 cm", {}, level="spl_30cm_db"),
    Choice("vowel", "i", {"vowel": "i"}),
    Choice("vowel", "u", {"vowel": "u"}),
    Choice("vowel", "AE", {"vowel": "AE"}),
    Choice("time step", "the paper's", {"run": {"time_step_s": PAPER_STEP_S}}, control=True),
)
#: In addition to the pairs: other changes of strain and angle, each with the shorter length of the posturing.
_SHORT = CHOICES[0]


def both(first: Choice, second: Choice) -> Choice:
    """Two choices at once."""
    level = next((choice.level for choice in (first, second) if choice.level != LEVEL), LEVEL)
    fold = next((choice.fold for choice in (first, second) if choice.fold is not prepare), prepare)
    return Choice(f"{first.name} +", second.name, flat(first.change) | flat(second.change), level, fold)


DESIGNED = tuple(
    both(choice, _SHORT)
    for choice in CHOICES
    if choice.factor in ("posturing tissue", "posturing set", "TA of the posturing")
)
