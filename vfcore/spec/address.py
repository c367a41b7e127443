"""The address of a result: a hash of what is computed, and of the versions that give it its meaning.

Two requests have the same address exactly when they resolve to the same computation. A computation therefore names no
variant and no posturing set: it holds the equations they select and every constant, overridden or not. It names no side
where both folds are equal, and no kind of lesion: it holds one fold, or the left and the right one.
"""

import dataclasses
import hashlib
import json
from collections.abc import Mapping
from functools import cached_property, lru_cache
from types import MappingProxyType
from typing import Any, NamedTuple

from vfcore.spec.declarations import SIDES
from vfcore.spec.larynx import CONSTANTS
from vfcore.spec.paths import DECLARATIONS, LARYNX, LISTS, default_values, item_of, one_form
from vfcore.spec.request import merged, own_values_of
from vfcore.spec.simulation import Simulation
from vfcore.version import ADDRESS_VERSION, MODEL_VERSION

#: Names of published choices, left out because their values are among the constants.
NAMES_ONLY = ("model.variant", "model.posture_set")
_NOTHING: Mapping[str, Any] = MappingProxyType({})


class FoldValues(NamedTuple):
    """Everything that one fold is computed from.

    ``settings``: every value by path but those of the larynx, and the values of each list that is not empty.
    ``constants``: the larynx, in the order of CONSTANTS.
    """

    settings: Mapping[str, Any]
    constants: tuple[float, ...]

    def patched(self, patch: Mapping[str, Any]) -> "FoldValues":
        """The values with those of a patch, which is not checked."""
        settings, constants = dict(self.settings), self.constants
        changed: dict[str, float] = {}
        for path, value in patch.items():
            row = DECLARATIONS.get(path)
            if row is None:  # an optional part, taken away
                settings = {other: kept for other, kept in settings.items() if not other.startswith(f"{path}.")}
                settings[path] = None
            elif row.part == LARYNX:
                changed[row.name] = one_form(row, value)
            else:
                for optional in row.optional:
                    if settings.pop(optional, optional) is None:
                        settings |= default_values(optional)
                settings[path] = one_form(row, value)
        if changed:
            constants = tuple(changed.get(name, value) for name, value in zip(CONSTANTS, constants, strict=True))
        return FoldValues(settings, constants)


@dataclasses.dataclass(frozen=True)
class Computation:
    """What a request resolves to. Two are equal when they compute the same.

    ``own``: the values of the request, whatever differs between the sides. ``sides``: the values that a side replaces,
    by their paths within it. ``lists``: the objects of each list. ``misplaced``: numbers of objects that no list can
    have, because those before them are missing; they give an impossible point of a sweep an address of its own.
    """

    own: FoldValues
    sides: Mapping[str, Mapping[str, Any]] = dataclasses.field(default_factory=dict)
    lists: Mapping[str, tuple] = dataclasses.field(default_factory=dict)
    misplaced: Mapping[str, float] = dataclasses.field(default_factory=dict)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Computation) and self.folds == other.folds

    def __hash__(self) -> int:
        return hash(self.address())

    @cached_property
    def folds(self) -> tuple[FoldValues, ...]:
        """The values of one fold where both are the same, else of the left and of the right one."""
        if not (self.sides or self.lists or self.misplaced):
            return (self.own,)
        left, right = (self._fold(side) for side in SIDES)
        return (left,) if left == right else (left, right)

    def _fold(self, side: str) -> FoldValues:
        fold = self.own.patched(self.sides.get(side, _NOTHING))
        lists = {name: _values(LISTS[name].on_side(items, side)) for name, items in self.lists.items()}
        settings = {**fold.settings, **self.misplaced, **{name: values for name, values in lists.items() if values}}
        return FoldValues(settings, fold.constants)

    def with_numbers(self, numbers: Mapping[str, float]) -> "Computation":
        """The computation of ``patched``, without building the request: a sweep needs one for every point."""
        own: dict[str, float] = {}
        sides, lists, misplaced = dict(self.sides), dict(self.lists), dict(self.misplaced)
        items: dict[str, dict[int, dict[str, float]]] = {}
        for path, value in numbers.items():
            first, _, rest = path.partition(".")
            if first in SIDES:
                sides[first] = merged(sides.get(first, _NOTHING), {rest: value})
            elif (item := item_of(path)) is not None:
                items.setdefault(first, {}).setdefault(item[1], {})[item[2]] = value
            else:
                own[path] = value
        for name, given in items.items():
            objects = list(lists.get(name, ()))
            for k in sorted(given):
                if k > len(objects):
                    misplaced |= {f"{name}.{k}.{value}": number for value, number in given[k].items()}
                elif k == len(objects):
                    objects.append(LISTS[name].kind(**given[k]))
                else:
                    objects[k] = dataclasses.replace(objects[k], **given[k])
            lists[name] = tuple(objects)
        return Computation(self.own.patched(own) if own else self.own, sides, lists, misplaced)

    def address(self, *more: Any) -> str:
        """The address of its result; ``more`` says what else it depends on."""
        return content_hash([[[fold.settings, _digest(fold.constants)] for fold in self.folds], *more])


def computation(request: Simulation) -> Computation:
    """The computation that a request resolves to."""
    settings, constants = {}, []
    for path, value in own_values_of(request).items():
        if path.startswith(f"{LARYNX}."):
            constants.append(value)
        elif path not in NAMES_ONLY:
            settings[path] = value
    sides = {name: dict(side.values) for name in SIDES if (side := getattr(request, name)) is not None}
    lists = {name: items for name in LISTS if (items := getattr(request, name))}
    return Computation(FoldValues(settings, tuple(constants)), sides, lists)


def address(request: Simulation) -> str:
    """The address of the result of a request."""
    return computation(request).address()


def content_hash(document: Any) -> str:
    """Hash of a plain document, the model version and the address version: 32 hexadecimal digits."""
    versions = [MODEL_VERSION, ADDRESS_VERSION]
    text = json.dumps([*versions, document], sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def _values(items: tuple) -> list[list[Any]]:
    """Every value of each object, in the order of its fields."""
    return [[_one(getattr(item, spec.name)) for spec in dataclasses.fields(item)] for item in items]


def _one(value: Any) -> Any:
    return value if isinstance(value, str | bool) or value is None else float(value) + 0.0


@lru_cache(maxsize=256)
def _digest(constants: tuple[float, ...]) -> str:
    """Hash of the constants, cached: most points of a sweep share them."""
    return content_hash(constants)
