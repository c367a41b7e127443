"""The published sets of posturing constants, one literal each, and overrides by name.

Geometry (length, section, direction cosines, moment arm, active width) and joints are common to the published sets;
the stress laws differ. A set may change any of them. Sources: Titze & Hunter (2007), JASA 121(4):2254–2260, and those
named in each set.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cache
from types import MappingProxyType
from typing import Any, NamedTuple

from vfcore.errors import ParameterError
from vfcore.spec.fields import PAPER, check_number, validate
from vfcore.spec.joints import JointConstants
from vfcore.spec.muscles import Muscle


class Geometry(NamedTuple):
    """Geometry of a force, and the strain where it is largest; fields as in ``Muscle``."""

    rest_length_m: float
    cross_section_m2: float
    strain_at_max_active_stress: float
    active_width_b: float
    alpha: float
    beta: float
    gamma_m: float


class StressLaw(NamedTuple):
    """Passive and active stress of a force; fields as in ``Muscle``."""

    sigma_0_pa: float
    sigma_2_pa: float
    epsilon_1: float
    epsilon_2: float
    exponential_B: float
    sigma_max_active_pa: float


# Rows as in Geometry: length, section, ε_m, b, α, β, γ.
GEOMETRY = {
    "lca": Geometry(0.0144, 2.12e-5, 0.4, 2.37, -0.198, 0.886, 0.003915),
    "ia": Geometry(0.0093, 1.22e-5, 0.4, 1.25, -0.697, -0.644, -0.0033),
    "pca": Geometry(0.015, 3.44e-5, 0.4, 1.86, -0.1, -0.95, -0.00549),
    "ct": Geometry(0.0138, 7.38e-5, 0.0, 2.4, 0.0, 0.0, 0.0),
    "ta": Geometry(0.0173, 4.09e-5, 0.2, 1.07, 0.015, 0.99, 0.0008),
    "lig": Geometry(0.0173, 6.1e-6, 1.0, 1.0, 0.0, 0.0, 0.0),
    "muc": Geometry(0.0173, 5e-6, 1.0, 1.0, 0.0, 0.0, 0.0),
}


@dataclass(frozen=True, slots=True)
class PostureSet:
    """One published set. ``joints``: the joint constants that differ from the common ones, by name."""

    source: str
    stresses: Mapping[str, StressLaw]
    geometry: Mapping[str, Geometry] = field(default_factory=lambda: GEOMETRY)
    joints: Mapping[str, float] = field(default_factory=dict)


# Rows as in StressLaw: σ_0, σ_2, ε_1, ε_2, B, σ_max.
_ALZAMENDI = {
    "lca": StressLaw(3000.0, 59000.0, -0.5, -0.06, 4.0, 1e5),
    "ia": StressLaw(2000.0, 30000.0, -0.5, -0.06, 3.5, 1e5),
    "pca": StressLaw(5000.0, 55000.0, -0.5, -0.05, 5.3, 1e5),
    "ct": StressLaw(2200.0, 5000.0, -0.5, 0.0, 7.0, 3e5),
    "ta": StressLaw(1000.0, 1500.0, -0.5, -0.05, 6.5, 1.5e5),
    "lig": StressLaw(500.0, 1400.0, -0.5, -0.3, 13.0, 0.0),
    "muc": StressLaw(500.0, 20000.0, -0.5, -0.3, 4.4, 0.0),
}
#: The first is the default. ``serry2026``: the paper's own table for mucosa, ligament and TA, the other muscles as in
#: ``alzamendi2020``. The paper says only that it tuned the constants of Alzamendi et al. (2022). The values of its
#: posturing are known from secondary evidence: TA with ε_m = 0.4, b = 1.07, σ_max = 100 kPa. Its table of the vibrating
#: fold has ε_m,ta = 0.3 and α_2,ta = 1.
POSTURE_SETS: Mapping[str, PostureSet] = {
    "serry2026": PostureSet(
        source=f"{PAPER}, table of constitutive parameters; other muscles: Alzamendi et al. (2022)",
        stresses=_ALZAMENDI
        | {
            "ta": StressLaw(2000.0, 1000.0, -0.5, -0.05, 9.0, 1e5),
            "lig": StressLaw(500.0, 1000.0, -0.5, -0.3, 7.0, 0.0),
            "muc": StressLaw(1000.0, 1000.0, -0.5, -0.3, 6.0, 0.0),
        },
        geometry=GEOMETRY | {"ta": GEOMETRY["ta"]._replace(strain_at_max_active_stress=0.4)},
    ),
    "alzamendi2020": PostureSet(
        source="Alzamendi et al. (2022), JASA 151(1):17–30 (triangular body-cover model)",
        stresses=_ALZAMENDI,
    ),
    "titze2006": PostureSet(
        source="Titze (2006), The Myoelastic Aerodynamic Theory of Phonation",
        stresses={
            "lca": StressLaw(3000.0, 59000.0, -0.5, 0.05, 4.0, 1e5),
            "ia": StressLaw(2000.0, 30000.0, -0.5, 0.0, 3.5, 1e5),
            "pca": StressLaw(5000.0, 55000.0, -0.5, 0.1, 5.3, 1e5),
            "ct": StressLaw(2200.0, 5000.0, -0.5, -0.06, 7.0, 9e4),
            "ta": StressLaw(1000.0, 1500.0, -0.5, -0.05, 6.5, 1.05e5),
            "lig": StressLaw(1000.0, 1400.0, -0.5, 0.0, 17.0, 0.0),
            "muc": StressLaw(1000.0, 9000.0, -0.5, -0.35, 4.4, 0.0),
        },
    ),
    "palaparthi2019": PostureSet(
        source="Palaparthi, Smith & Titze (2019), Appl. Sci. 9(21):4671",
        stresses={
            "lca": StressLaw(3000.0, 59000.0, -0.9, 0.05, 4.0, 1.4e5),
            "ia": StressLaw(2000.0, 30000.0, -0.9, 0.0, 3.5, 1.4e5),
            "pca": StressLaw(5000.0, 55000.0, -0.9, 0.1, 5.3, 1e5),
            "ct": StressLaw(2200.0, 5000.0, -0.9, -0.06, 7.0, 4e5),
            "ta": StressLaw(2000.0, 1500.0, -0.9, -0.5, 6.5, 1.8e5),
            "lig": StressLaw(2000.0, 150.0, -0.9, -0.5, 12.8, 0.0),
            "muc": StressLaw(200.0, 1500.0, -0.9, -0.2, 6.5, 0.0),
        },
    ),
}

# Field of PosturingConstants -> prefix of its override names.
_PREFIX = {"lca": "LCA_", "ia": "IA_", "pca": "PCA_", "ct": "CT_", "ta": "TA_", "lig": "lig_", "muc": "muc_"}
# Columns that no equation reads: an override would have no effect.
_UNUSED_PASSIVE = ("rest_length_m", "strain_at_max_active_stress", "active_width_b", "sigma_max_active_pa")
_UNUSED = {"lig": _UNUSED_PASSIVE, "muc": _UNUSED_PASSIVE, "ta": ("rest_length_m",), "ct": ("gamma_m",)}


@dataclass(frozen=True, slots=True, kw_only=True)
class PosturingConstants(JointConstants):
    """One complete set: five muscles, two passive tissues, two joints. SI throughout.

    ``set_name``: the published set it started from; ``source``: the source of its stress laws.
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
        """This set with constants replaced together, so that only the result has to be consistent.

        Raises ParameterError("constants.<name>", ...) for an unknown name or a value out of range.
        """
        if not values:
            return self
        joints: dict[str, Any] = {}
        rows: dict[str, dict[str, float]] = {}
        for name, value in values.items():
            if name not in _PLACES:
                known = "a name such as L_0_posture_m or LCA_rest_length_m"
                raise ParameterError(f"constants.{name}", "is not a posturing constant", known)
            metadata = CONSTANTS[name]
            check_number(f"constants.{name}", value, metadata["low"], metadata["high"], metadata["unit"])
            key, field_name = _PLACES[name]
            (joints if key is None else rows.setdefault(key, {}))[field_name] = float(value)
        muscles: dict[str, Any] = {key: replace(getattr(self, key), **row) for key, row in rows.items()}
        return replace(self, **joints, **muscles)


def _register() -> tuple[dict[str, tuple[str | None, str]], Mapping[str, Mapping[str, Any]]]:
    """Flat override name -> (row or None, field), and flat name -> metadata; joints first."""
    places: dict[str, tuple[str | None, str]] = {}
    metadata: dict[str, Mapping[str, Any]] = {}
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


def constant_names() -> Mapping[str, Mapping[str, Any]]:
    """Read-only mapping of every override name to its metadata (unit, label, low, high, source, symbol)."""
    return CONSTANTS


@cache
def posture_set(name: str) -> PosturingConstants:
    """The published set ``name``; ParameterError("model.posture_set", ...) when unknown."""
    if name not in POSTURE_SETS:
        raise ParameterError("model.posture_set", f"{name!r} is not known", " | ".join(POSTURE_SETS))
    chosen = POSTURE_SETS[name]
    numbers: dict[str, Any] = dict(chosen.joints)
    numbers |= {key: Muscle(*chosen.geometry[key], *chosen.stresses[key]) for key in _PREFIX}
    return PosturingConstants(set_name=name, source=chosen.source, **numbers)
