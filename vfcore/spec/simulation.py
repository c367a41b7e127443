"""The request of a run: frozen dataclasses in SI units, validated on creation.

The defaults are the paper's modal case. Field names are those of the JSON request document.
"""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Any, Self

from vfcore.errors import ParameterError
from vfcore.fold.constants import FoldConstants
from vfcore.spec.declarations import LARYNX, SIDES, lists_of
from vfcore.spec.fields import PAPER, changes_of, choice, flag, of_one_side, part, parts, quantity, validate
from vfcore.spec.larynx import Larynx, larynx_of
from vfcore.spec.lesions import Lesion, lesions_on
from vfcore.spec.posture_sets import POSTURE_SETS, PosturingConstants
from vfcore.spec.sides import Side, resolved_folds, side_of
from vfcore.spec.variants import VARIANTS

VOWELS = ("i", "I", "e", "E", "AE", "V", "a", "O", "o", "U", "u")
SECTION_TRAVEL_S = 0.0025 / 350.0  # one 0.25 cm tract section at the paper's speed of sound
PAPER_STEP_S = SECTION_TRAVEL_S / 4  # 1.7857e-6 s, the paper's time step
DEFAULT_STEP_S = SECTION_TRAVEL_S * 5  # 35.71e-6 s: output at 28 kHz, see docs/model/numerics.md

_MUSCLE = "normalised activation, 0 relaxed to 1 full"


@dataclass(frozen=True, slots=True)
class Activation:
    """Activation of the five intrinsic laryngeal muscles, each in [0, 1]."""

    ta: float = quantity(
        0.4, "1", "thyroarytenoid (TA)", 0, 1, step=0.01, symbol="a_ta", source=_MUSCLE,
        help="shortens the folds and bulges them medially",
    )  # fmt: skip
    ct: float = quantity(
        0.3, "1", "cricothyroid (CT)", 0, 1, step=0.01, symbol="a_ct", source=_MUSCLE,
        help="lengthens and tenses the folds: the pitch muscle",
    )  # fmt: skip
    lca: float = quantity(
        0.8, "1", "lateral cricoarytenoid (LCA)", 0, 1, step=0.01, symbol="a_lca", source=_MUSCLE,
        help="turns the vocal processes inward and closes the membranous glottis",
    )  # fmt: skip
    ia: float = quantity(
        0.8, "1", "interarytenoid (IA)", 0, 1, step=0.01, symbol="a_ia", source=_MUSCLE,
        help="draws the arytenoids together; with LCA it closes the back of the glottis",
    )  # fmt: skip
    pca: float = quantity(
        0.0, "1", "posterior cricoarytenoid (PCA)", 0, 1, step=0.01, symbol="a_pca", source=_MUSCLE,
        help="the only opener: draws the vocal processes apart",
    )  # fmt: skip

    def __post_init__(self):
        validate(self, "activation.")


@dataclass(frozen=True, slots=True)
class PostureOverride:
    """A posture given directly, without muscles: the posturing equations are skipped."""

    strain: float = quantity(0.0, "1", "nominal strain", -0.45, 0.6, symbol="ε̄", source="given by the user", step=0.005)
    glottal_half_angle_rad: float = quantity(
        0.0, "rad", "glottal half-angle", 0, 0.6, symbol="θ_g", source="given by the user", step=0.001
    )
    rest_angle_rad: float = quantity(
        0.254, "rad", "rest angle at the anterior commissure", -0.5, 1.0, symbol="θ_0",
        source="see constants.rest_angle_rad", help="of a given posture, in the place of constants.rest_angle_rad",
    )  # fmt: skip

    def __post_init__(self):
        validate(self, "posture.")


GRID_LIMITS = {"nx": (6, 200), "ny": (3, 100)}
STEP_LIMITS_S = (1e-8, 1e-3)
_NUMERICS = "numerical choice of this implementation"

COUPLING_GRADIENTS = ("inferior_stiff", "superior_stiff")
SHEAR_FORMS = ("kelvin_voigt", "rotation")
COUPLINGS = ("one_way", "two_way")
STRETCHES = ("linear", "finite")
#: Choices that the variant makes if the request does not.
BROUGHT_BY_VARIANT = ("posture_set", "coupling_gradient", "shear", "coupling", "stretch")


@dataclass(frozen=True, slots=True)
class Model:
    """The equations: a variant, and overrides of its choices.

    None is replaced by the variant's own choice on creation, so no field of a Model is None.
    """

    variant: str = choice("paper", "model variant", tuple(VARIANTS), source="docs/model/choices.md")
    posture_set: str = choice(
        None,
        "posturing constants",
        tuple(POSTURE_SETS),
        source="docs/reference/constants.md",
        help="left out: the variant's own",
    )  # fmt: skip
    coupling_gradient: str = choice(
        None, "direction of the coupling gradient", COUPLING_GRADIENTS, source="docs/model/choices.md, row 3",
        help="left out: the variant's own",
    )  # fmt: skip
    shear: str = choice(
        None, "membrane shear", SHEAR_FORMS, source="docs/model/choices.md, row 6", help="left out: the variant's own"
    )
    coupling: str = choice(
        None, "source–tract coupling", COUPLINGS, source=f"{PAPER}, Acoustic output; two_way: Titze (2008)",
        help="one_way: the tract hears the folds; two_way: the airways also act on the flow and on the folds; left "
        "out: the variant's own",
    )  # fmt: skip
    stretch: str = choice(
        None, "membrane tension", STRETCHES, source="docs/model/choices.md",
        help="linear: constant, as in the paper; finite: grows with the swing; left out: the variant's own",
    )  # fmt: skip

    def __post_init__(self):
        validate(self, "model.")
        for name in BROUGHT_BY_VARIANT:
            if getattr(self, name) is None:
                object.__setattr__(self, name, getattr(VARIANTS[self.variant], name))


@dataclass(frozen=True, slots=True)
class Run:
    """Numerical settings of the run."""

    duration_s: float = quantity(1.0, "s", "simulated time", 0.02, 60, source=f"{PAPER}, Simulation setup", step=0.1)
    nx: int = quantity(
        20, "1", "nodes along the fold", *GRID_LIMITS["nx"], whole=True, step=1, symbol="N_x", source=_NUMERICS,
        help="anterior to posterior, ends included",
    )  # fmt: skip
    ny: int = quantity(
        10, "1", "nodes over the thickness", *GRID_LIMITS["ny"], whole=True, step=1, symbol="N_y", source=_NUMERICS,
        help="superior to inferior, edges included",
    )  # fmt: skip
    time_step_s: float | None = quantity(
        None, "s", "time step", *STEP_LIMITS_S, symbol="Δt", source=_NUMERICS,
        help=f"null: chosen for the grid and the posture; the paper's is {PAPER_STEP_S!r}",
    )  # fmt: skip
    start: str = choice(
        "flat", "initial state", ("flat", "static"), source="an earlier version of the model started flat",
        help="flat: a 1e-9 m bump; static: the shape at zero pressure",
    )  # fmt: skip
    pressure_rise_s: float = quantity(
        0.0, "s", "rise time of the lung pressure", 0, 10, source="0: a step, as in the paper",
        help="linear ramp from 0 to the full pressure; 0 is a step", step=0.01,
    )  # fmt: skip

    error_estimate: bool = flag(
        False,
        "error bars of the measures",
        source="docs/model/numerics.md",
        help="two more runs on finer grids estimate how far each measure is from its fine-grid limit; about 12 times "
        "the work",
    )

    def __post_init__(self):
        validate(self, "run.")

    @property
    def step_s(self) -> float:
        """The time step, s."""
        return DEFAULT_STEP_S if self.time_step_s is None else float(self.time_step_s)


@dataclass(frozen=True, slots=True)
class Simulation:
    """One complete request; fields not given have the values of the paper's modal case.

    ``left``, ``right``: the values in which the fold of that side differs, None where it does not; see
    ``vfcore.spec.sides.folds_of``. ``larynx``: None is replaced by that of the model's variant and posturing set on
    creation. ``folds``: what ``folds_of`` returns, None where it is the request itself.
    """

    activation: Activation = part(Activation, per_side=True)
    subglottal_pressure_pa: float = quantity(
        1000.0, "Pa", "lung pressure", 0, 5000, symbol="P_s", source=f"{PAPER}, Simulation setup", step=10,
        help="the steady pressure below the folds",
    )  # fmt: skip
    convergence_angle_rad: float = quantity(
        0.02, "rad", "convergence angle", -0.02, 0.3, symbol="θ_conv", step=0.001,
        source=f"{PAPER}, table of resting dimensions",
        help="angle between the medial plane and the anterior edge; positive converges towards the mouth",
        per_side=True,  # each fold has its own medial plane
    )  # fmt: skip
    vowel: str = choice("a", "vowel", VOWELS, source="Story (2008), JASA 123(1):327–335")
    model: Model = part(Model)
    posture: PostureOverride | None = part(PostureOverride, optional=True, per_side=True)
    run: Run = part(Run)
    left: Side | None = of_one_side()
    right: Side | None = of_one_side()
    lesions: tuple[Lesion, ...] = parts(
        Lesion, "lesions", at_most=8, on_side=lesions_on,
        help="patches of other material and shape on the folds, each with a kind that brings its numbers",
    )  # fmt: skip
    larynx: Larynx = field(default=None)  # type: ignore[assignment]  # replaced on creation
    folds: tuple["Simulation", ...] | None = field(default=None, init=False, repr=False, compare=False)

    def __post_init__(self):
        validate(self)
        self._check_lists()
        if self.larynx is None:
            object.__setattr__(self, "larynx", larynx_of(self.model.variant, self.model.posture_set))
        if self.run.pressure_rise_s > self.run.duration_s:
            raise ParameterError(
                "run.pressure_rise_s",
                f"{self.run.pressure_rise_s:g} is longer than the run",
                f"0 to run.duration_s = {self.run.duration_s:g} s",
            )
        for side in SIDES:
            object.__setattr__(self, side, side_of(getattr(self, side)))
        object.__setattr__(self, "folds", resolved_folds(self))

    def _check_lists(self):
        kind: Any = type(self)
        for name, row in lists_of(kind).items():
            items = tuple(getattr(self, name))
            if len(items) > row.at_most:
                raise ParameterError(name, f"{len(items)} are too many", f"up to {row.at_most}")
            for k, item in enumerate(items):
                if not isinstance(item, row.kind):
                    raise ParameterError(f"{name}.{k}", f"{type(item).__name__} is not an object", ", ".join(row.rows))
            object.__setattr__(self, name, items)

    @property
    def constants(self) -> FoldConstants:
        """The constants of the vibrating fold."""
        return self.larynx.fold

    @property
    def posturing(self) -> PosturingConstants:
        """The constants of joints and muscles."""
        return self.larynx.posturing

    def with_activation(self, activation: Activation) -> Self:
        """The same request with other muscles. Without renewed checks, since all else is unchanged: a moving voice
        needs a hundred a second, and ``dataclasses.replace`` takes ten times as long.
        """
        moved = self.copied(activation=activation)
        if self.folds is not None:
            object.__setattr__(moved, "folds", resolved_folds(moved))
        return moved

    def with_values(self, tree: Mapping[str, Any], **fields: Any) -> Self:
        """The same request with the values of a tree, in which parts are mappings, and with other ``fields``.

        Raises ParameterError with the path of a value that cannot be used.
        """
        if not fields and tree.keys() == {"activation"}:
            return self.with_activation(dataclasses.replace(self.activation, **tree["activation"]))
        if constants := tree.get(LARYNX):
            fields["larynx"] = self.larynx.override(constants)
        rest = {name: value for name, value in tree.items() if name != LARYNX}
        return dataclasses.replace(self, **fields, **changes_of(self, rest))

    def copied(self, **fields: Any) -> Self:
        """The same request with other fields, without any check."""
        kind: Any = type(self)
        copy = object.__new__(kind)
        for name in _field_names(kind):
            object.__setattr__(copy, name, fields[name] if name in fields else getattr(self, name))
        return copy


@cache
def _field_names(kind: Any) -> tuple[str, ...]:
    return tuple(spec.name for spec in dataclasses.fields(kind))
