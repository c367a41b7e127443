"""Lesions of the vocal folds: smooth patches that change material and rest shape of a fold at one place.

A lesion names its kind, and the kind brings the numbers that are not given. The kinds are pictures of what clinics
name, not fitted to patients: signs and rough sizes are those of the literature named with each, and no value was
calibrated.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields, replace
from functools import lru_cache

from vfcore.spec.fields import choice, quantity, validate

BOTH = "both"
CUSTOM = "custom"


@dataclass(frozen=True, slots=True)
class LesionKind:
    """Numbers that a kind of lesion brings, named as in ``Lesion``, and the reason for them."""

    label: str
    why: str
    x: float = 0.5
    y: float = 0.5
    length_mm: float = 1.5
    width_mm: float = 1.5
    height_mm: float = 0.0
    mass_ratio: float = 1.0
    stiffness_ratio: float = 1.0
    viscosity_ratio: float = 1.0


KINDS: Mapping[str, LesionKind] = {
    "nodule": LesionKind(
        "nodules",
        "Mostly on both folds, at the middle of the membranous part where contact is hardest, 1 to 2 mm long; raised "
        "and, once fibrous, stiffer than the cover. The impact stress is largest there (Jiang & Titze 1994).",
        height_mm=0.4, stiffness_ratio=2.0,
    ),
    "polyp": LesionKind(
        "polyp",
        "Mostly on one fold, so that a side should be given; a soft, heavy mass on the edge, larger than a nodule "
        "(Zhang & Jiang 2004 model it as added mass of one fold).",
        length_mm=2.5, width_mm=2.0, height_mm=0.8, mass_ratio=2.0, stiffness_ratio=0.7,
    ),
    "oedema": LesionKind(
        "Reinke's oedema",
        "Fluid in the whole superficial layer: more mass, softer, over the whole cover; extents beyond those of any "
        "fold make it uniform (Hirano 1981).",
        length_mm=20.0, width_mm=20.0, mass_ratio=2.0, stiffness_ratio=0.6,
    ),
    "scar": LesionKind(
        "scar",
        "Collagen in place of the superficial layer: several times as stiff and more viscous than the layer it "
        "replaces, so that the wave stops there (Thibeault et al. 2002; Rousseau et al. 2004).",
        length_mm=4.0, width_mm=3.0, stiffness_ratio=4.0, viscosity_ratio=2.0,
    ),
    "sulcus": LesionKind(
        "sulcus vocalis",
        "A groove along the edge, stiff because the cover adheres to the ligament (Ford et al. 1996).",
        y=0.3, length_mm=8.0, width_mm=1.0, height_mm=-0.4, stiffness_ratio=3.0,
    ),
    "bowing": LesionKind(
        "bowing",
        "A concave edge at rest, over the length of a man's fold and its whole thickness, as in the aged larynx; the "
        "loss of tissue is in the shape only (Honjo & Isshiki 1980).",
        length_mm=15.0, width_mm=20.0, height_mm=-0.5,
    ),
    CUSTOM: LesionKind("own lesion", "Without effect until a height or a ratio is given."),
}  # fmt: skip

_OWN = "left out: the kind's own"
_PLACE, _SIZE = "place given by the user", "extent given by the user"
_RATIO = "ratio to the healthy fold, given by the user"


@dataclass(frozen=True, slots=True)
class Lesion:
    """One lesion. A number that is None is replaced by that of the kind on creation, so that none is None.

    Raises ParameterError with the name of the field for a value out of range.
    """

    side: str = choice(
        BOTH, "side", ("left", "right", BOTH), source="the patient's side", help="both: the same on both folds"
    )
    kind: str = choice(CUSTOM, "kind", tuple(KINDS), source="vfcore/spec/lesions.py", help="brings the other values")
    x: float = quantity(
        None, "1", "place along the fold", 0, 1, symbol="x/L", source=_PLACE, step=0.01,
        help=f"centre, 0 anterior to 1 posterior; {_OWN}",
    )  # fmt: skip
    y: float = quantity(
        None, "1", "place over the thickness", 0, 1, symbol="y/b", source=_PLACE, step=0.01,
        help=f"centre, 0 superior edge to 1 inferior edge; {_OWN}",
    )  # fmt: skip
    length_mm: float = quantity(None, "mm", "extent along the fold", 0.2, 20, source=_SIZE, step=0.1, help=_OWN)
    width_mm: float = quantity(None, "mm", "extent over the thickness", 0.2, 20, source=_SIZE, step=0.1, help=_OWN)
    height_mm: float = quantity(
        None, "mm", "height", -2, 2, source=_SIZE, step=0.05,
        help=f"moves the medial surface towards the other fold; negative: a dip; {_OWN}",
    )  # fmt: skip
    mass_ratio: float = quantity(
        None, "1", "mass ratio", 0.1, 10, source=_RATIO, step=0.1, help=f"of the cover at the centre; {_OWN}"
    )
    stiffness_ratio: float = quantity(
        None, "1", "stiffness ratio", 0.1, 10, source=_RATIO, step=0.1,
        help=f"of tension, shear, coupling and contact at the centre; {_OWN}",
    )  # fmt: skip
    viscosity_ratio: float = quantity(
        None, "1", "viscosity ratio", 0.1, 10, source=_RATIO, step=0.1,
        help=f"of the dampers of shear, coupling and contact at the centre; {_OWN}",
    )  # fmt: skip

    def __post_init__(self):
        validate(self)
        own = KINDS[self.kind]
        for name in _NUMBERS:
            if getattr(self, name) is None:
                object.__setattr__(self, name, getattr(own, name))

    @property
    def numbers(self) -> tuple[float, ...]:
        """Every number, in the order of the fields."""
        return tuple(getattr(self, name) for name in _NUMBERS)

    @property
    def has_effect(self) -> bool:
        """Whether a fold with this lesion differs from one without."""
        return self.height_mm != 0 or any(getattr(self, name) != 1 for name in _RATIOS)


_NUMBERS = tuple(spec.name for spec in fields(Lesion) if spec.metadata["type"] == "number")
_RATIOS = tuple(name for name in _NUMBERS if name.endswith("_ratio"))


def lesions_on(lesions: Iterable[Lesion], side: str) -> tuple[Lesion, ...]:
    """The lesions of one fold: those with an effect, of side both and kind custom, in one order.

    Two folds with the same lesions have equal tuples, whatever names and order they were given in.
    """
    own = (lesion for lesion in lesions if lesion.side in (side, BOTH) and lesion.has_effect)
    return tuple(sorted(map(_nameless, own), key=lambda lesion: lesion.numbers))


@lru_cache(maxsize=256)  # a played voice needs them a hundred times a second
def _nameless(lesion: Lesion) -> Lesion:
    return replace(lesion, side=BOTH, kind=CUSTOM)
