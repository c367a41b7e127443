"""The published sets of posturing constants, and how one of their numbers is overridden by name.

``serry2026`` (default): the paper's own table for mucosa, ligament and TA, the other muscles as in
``alzamendi2020``, TA with ε_m = 0.4, b = 1.07, σ_max = 100 kPa. The paper says only that it tuned the
constants of Alzamendi et al. (2022); which values its posturing uses is known by secondary evidence.
"""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cache
from types import MappingProxyType

from vfcore.errors import ParameterError
from vfcore.spec.fields import PAPER, check_number, validate
from vfcore.spec.joints import JointConstants
from vfcore.spec.muscles import Muscle, muscle

SOURCES = {
    "serry2026": f"{PAPER}, table of constitutive parameters; other muscles: Alzamendi et al. (2022)",
    "alzamendi2020": "Alzamendi et al. (2022), JASA 151(1):17–30 (triangular body-cover model)",
    "titze2006": "Titze (2006), The Myoelastic Aerodynamic Theory of Phonation",
    "palaparthi2019": "Palaparthi, Smith & Titze (2019), Appl. Sci. 9(21):4671",
}
POSTURE_SETS: tuple[str, ...] = tuple(SOURCES)

# Field of PosturingConstants -> prefix of its override names.
_PREFIX = {"lca": "LCA_", "ia": "IA_", "pca": "PCA_", "ct": "CT_", "ta": "TA_", "lig": "lig_", "muc": "muc_"}
# Columns of the tables that no equation reads: overriding one would promise an effect it has not.
_UNUSED_PASSIVE = ("rest_length_m", "strain_at_max_active_stress", "active_width_b", "sigma_max_active_pa")
_UNUSED = {"lig": _UNUSED_PASSIVE, "muc": _UNUSED_PASSIVE, "ta": ("rest_length_m",), "ct": ("gamma_m",)}


@dataclass(frozen=True, slots=True, kw_only=True)
class PosturingConstants(JointConstants):
    """One complete set: five muscles, two passive tissues, two joints. SI throughout.

    ``set_name`` is the published set it started from, ``source`` where its stress laws come from.
    Raises ParameterError("constants.<name>", ...) for a number out of range.
    """

    set_name: str
    source: str
    lca: Muscle
    ia: Muscle
    pca: Muscle
    ct: Muscle
    ta: Muscle
    lig: Muscle
    muc: Muscle

    def __post_init__(self):
        validate(self, "constants.")
        for key, prefix in _PREFIX.items():
            row = getattr(self, key)
            validate(row, f"constants.{prefix}")
            if row.epsilon_2 < row.epsilon_1:
                raise ParameterError(
                    f"constants.{prefix}epsilon_2",
                    f"{row.epsilon_2:g} is below {prefix}epsilon_1, where the stress would jump",
                    f"{row.epsilon_1:g} to 1",
                )
        if self.vocal_process_x_m >= self.x_CAJ_m:
            raise ParameterError(
                "constants.vocal_process_x_m",
                f"{self.vocal_process_x_m:g} is not medial of the joint",
                f"below x_CAJ_m = {self.x_CAJ_m:g} m",
            )

    def value(self, name: str) -> float:
        """The constant ``name`` of this set (a key of ``constant_names``)."""
        key, field_name = _PLACES[name]
        return getattr(self if key is None else getattr(self, key), field_name)

    def override(self, name: str, value: float) -> "PosturingConstants":
        """This set with the constant ``name`` (see ``constant_names``) replaced by ``value``."""
        return self.override_all({name: value})

    def override_all(self, values: Mapping[str, float]) -> "PosturingConstants":
        """This set with several constants replaced at once, so that only the outcome has to be consistent.

        Raises ParameterError("constants.<name>", ...) for an unknown name or a value out of range.
        """
        if not values:
            return self
        changes: dict[str | None, dict[str, float]] = {}
        for name, value in values.items():
            if name not in _PLACES:
                known = "a name such as L_0_posture_m or LCA_rest_length_m"
                raise ParameterError(f"constants.{name}", "is not a posturing constant", known)
            metadata = CONSTANTS[name]
            check_number(f"constants.{name}", value, metadata["low"], metadata["high"], metadata["unit"])
            key, field_name = _PLACES[name]
            changes.setdefault(key, {})[field_name] = float(value)
        joints = changes.pop(None, {})
        return replace(self, **joints, **{key: replace(getattr(self, key), **row) for key, row in changes.items()})


def _register():
    """Flat override name -> (row or None, field), and flat name -> metadata; joints first."""
    places, metadata = {}, {}
    for spec in fields(JointConstants):
        places[spec.name], metadata[spec.name] = (None, spec.name), spec.metadata
    for key, prefix in _PREFIX.items():
        for spec in fields(Muscle):
            if spec.name in _UNUSED.get(key, ()):
                continue
            name = prefix + spec.name
            label = f"{prefix[:-1]}: {spec.metadata['label']}"
            places[name] = (key, spec.name)
            metadata[name] = MappingProxyType({**spec.metadata, "label": label})
    return places, MappingProxyType(metadata)


_PLACES, CONSTANTS = _register()


def constant_names():
    """Read-only mapping of every override name to its metadata (unit, label, low, high, source, symbol)."""
    return CONSTANTS


@cache
def posture_set(name: str) -> PosturingConstants:
    """The published set ``name``; ParameterError("model.posture_set", ...) when unknown."""
    if name not in SOURCES:
        raise ParameterError("model.posture_set", f"{name!r} is not known", " | ".join(POSTURE_SETS))
    return PosturingConstants(set_name=name, source=SOURCES[name], **{key: muscle(name, key) for key in _PREFIX})
