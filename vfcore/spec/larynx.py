"""A larynx: everything a subject is made of, as one record of numbers that a request can change by name.

It has four tables: the vibrating fold, the joints and muscles that posture it, and the airways around it. Each is a
dataclass with unit, range and source per number. Here they share one set of names, those under ``constants`` in a
request.
"""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from types import MappingProxyType
from typing import Any, NamedTuple

from vfcore.errors import ParameterError
from vfcore.fold.constants import FoldConstants
from vfcore.spec.fields import quantity, validate
from vfcore.spec.posture_sets import PosturingConstants, constant_names, posture_set
from vfcore.spec.variants import VARIANTS


@dataclass(frozen=True, slots=True)
class AirwayConstants:
    """Size of the airways below and above the glottis."""

    airway_scale: float = quantity(
        1.0, "1", "size of both airways", 0.5, 1.5, symbol="s_a", step=0.01,
        source="1: the published male airways (Story 2008; Zañartu et al. 2007)",
        help="all lengths and diameters, relative to the published ones", common="both folds have the same airways",
    )  # fmt: skip

    def __post_init__(self):
        validate(self, "constants.")


class Constant(NamedTuple):
    """One number of a larynx: the table that holds it, its declaration, and its value in the paper's larynx."""

    table: str
    metadata: Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Larynx:
    """One subject. Raises ParameterError("constants.<name>", …) for a number out of range."""

    fold: FoldConstants
    posturing: PosturingConstants
    airways: AirwayConstants

    def value(self, name: str) -> float:
        """The constant ``name``, a key of CONSTANTS."""
        table = CONSTANTS[name].table
        return self.posturing.value(name) if table == "posturing" else getattr(getattr(self, table), name)

    def values(self) -> dict[str, float]:
        """Every constant by name, in the order of CONSTANTS."""
        fold, airways = (dict(zip(_NAMES[table], _read(self, table), strict=True)) for table in ("fold", "airways"))
        return fold | {name: self.posturing.value(name) for name in _NAMES["posturing"]} | airways

    def override(self, changes: Mapping[str, float]) -> "Larynx":
        """This larynx with constants replaced together, so that only the result has to be consistent."""
        if not changes:
            return self
        by_table: dict[str, dict[str, float]] = {}
        for name, value in changes.items():
            if name not in CONSTANTS:
                raise ParameterError(f"constants.{name}", "is not a constant of the model", KNOWN_CONSTANTS)
            by_table.setdefault(CONSTANTS[name].table, {})[name] = value
        posturing = self.posturing.override_all(by_table.pop("posturing", {}))
        tables = {table: replace(getattr(self, table), **values) for table, values in by_table.items()}
        return replace(self, posturing=posturing, **tables)


KNOWN_CONSTANTS = "the names listed by `vocalis posture --constants` and by GET /api/v1/parameters"


def _constants() -> Mapping[str, Constant]:
    found = {spec.name: Constant("fold", spec.metadata) for spec in dataclasses.fields(FoldConstants)}
    found |= {name: Constant("posturing", metadata) for name, metadata in constant_names().items()}
    found |= {spec.name: Constant("airways", spec.metadata) for spec in dataclasses.fields(AirwayConstants)}
    return MappingProxyType(found)


#: Every constant of a larynx by its name in a request.
CONSTANTS = _constants()
_NAMES = {
    table: tuple(name for name, constant in CONSTANTS.items() if constant.table == table)
    for table in ("fold", "posturing", "airways")
}


def _read(larynx: Larynx, table: str) -> list[float]:
    return [getattr(getattr(larynx, table), name) for name in _NAMES[table]]


@cache
def larynx_of(variant: str, posture_set_name: str) -> Larynx:
    """The subject of a model variant with a published posturing set: the set's own numbers, then the variant's."""
    base = Larynx(FoldConstants(), posture_set(posture_set_name), AirwayConstants())
    return base.override(VARIANTS[variant].overrides)


#: The paper's subject.
PAPER_LARYNX = larynx_of("paper", VARIANTS["paper"].posture_set)
