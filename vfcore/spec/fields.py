"""One declaration per number: unit, label, range, source and help are metadata of the field.

The parameter schema, the validator, the command line's help and docs/reference/ all read
the metadata that ``quantity`` attaches to a dataclass field.
"""

import dataclasses
import math
import sys
from collections.abc import Callable, Mapping
from functools import cache
from numbers import Real
from typing import Any

from vfcore.errors import ParameterError

PAPER = "Serry, Zañartu & Peterson (2026)"


def quantity(
    default: Any,
    unit: str,
    label: str,
    low: float,
    high: float,
    *,
    source: str,
    help: str = "",
    symbol: str = "",
    step: float | None = None,
    whole: bool = False,
    per_side: bool = False,
    common: str = "",
) -> Any:
    """A number field of a frozen dataclass, valid on the closed interval [low, high].

    ``default`` None: the field may be null, and its class says what that means. ``whole``: the number is an integer.
    ``per_side``: the number may differ between the left and the right fold. ``common``: why a number cannot, although
    all others of its part or table may.
    """
    return dataclasses.field(
        default=default,
        metadata={
            "type": "integer" if whole else "number",
            "unit": unit,
            "label": label,
            "low": low,
            "high": high,
            "source": source,
            "help": help,
            "symbol": symbol,
            "step": step,
            "per_side": per_side,
            "common": common,
        },
    )


def choice(default: str | None, label: str, options: tuple[str, ...], *, source: str, help: str = "") -> Any:
    """A string field that takes one of ``options``; with the default None also null."""
    return dataclasses.field(
        default=default,
        metadata={"type": "choice", "label": label, "options": options, "source": source, "help": help},
    )


def flag(default: bool, label: str, *, source: str, help: str = "") -> Any:
    """A field that is true or false."""
    return dataclasses.field(
        default=default, metadata={"type": "boolean", "label": label, "source": source, "help": help}
    )


def part(kind: type, *, optional: bool = False, per_side: bool = False) -> Any:
    """A field that is an object of a request: a dataclass of declared fields.

    ``optional``: the object may be null, and is null by default. ``per_side``: its values may differ between the left
    and the right fold. Everything that reads requests (paths, documents, addresses, schema, the server's bodies)
    follows this declaration.
    """
    return dataclasses.field(
        metadata={"part": kind, "optional": optional, "per_side": per_side},
        **({"default": None} if optional else {"default_factory": kind}),
    )


def _all_of_it(items: tuple, side: str) -> tuple:
    return items


def parts(
    kind: type, label: str, *, at_most: int, help: str = "", on_side: Callable[[tuple, str], tuple] = _all_of_it
) -> Any:
    """A field at the top of a request that is a list of objects, empty by default: a tuple of ``kind``.

    ``at_most``: the largest number of objects. ``on_side``: the objects that the fold of a side ("left" or "right")
    has, in a form in which equal folds have equal objects; by default all of them. A value of an object that is null
    by default is filled in by its class, from those that are not.
    """
    return dataclasses.field(
        default=(), metadata={"parts": kind, "label": label, "at_most": at_most, "help": help, "on_side": on_side}
    )


def of_one_side() -> Any:
    """A field at the top of a request that holds what differs on one side: a ``vfcore.spec.sides.Side`` or None."""
    return dataclasses.field(default=None, metadata={"side": True})


@cache
def _parts_in(kind: Any) -> Mapping[str, type]:
    """The objects directly in a request class or in one of its parts, by the names of their fields."""
    return {spec.name: spec.metadata["part"] for spec in dataclasses.fields(kind) if "part" in spec.metadata}


def made(kind: Any, tree: Mapping[str, Any]) -> Any:
    """An object of ``kind`` with the values of a tree, in which parts are mappings; the others have their defaults."""
    inner = _parts_in(kind)
    return kind(
        **{
            name: made(inner[name], value) if name in inner and value is not None else value
            for name, value in tree.items()
        }
    )


def changes_of(owner: Any, tree: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of an object that the values of a tree replace; parts of the tree are mappings."""
    changes: dict[str, Any] = {}
    kind: Any = type(owner)
    inner = _parts_in(kind)
    for name, value in tree.items():
        if name in inner and value is not None:
            old = getattr(owner, name)
            changes[name] = (
                made(inner[name], value) if old is None else dataclasses.replace(old, **changes_of(old, value))
            )
        else:
            changes[name] = value
    return changes


def validate(instance: Any, prefix: str = "") -> None:
    """Check every declared field of a dataclass; raise ParameterError for the first bad one."""
    kind: Any = type(instance)
    for name, low, high, spec in _declared(kind):
        value = getattr(instance, name)
        if type(value) is float and low <= value <= high:  # the usual case: not NaN, and in range
            continue
        if value is None and spec.default is None:
            continue
        check_value(f"{prefix}{name}", value, spec.metadata)
        if spec.metadata["type"] == "integer" and type(value) is not int:  # JSON does not distinguish 20.0 from 20
            object.__setattr__(instance, name, int(value))


def check_value(path: str, value: Any, metadata: Mapping[str, Any]) -> None:
    """Raise ParameterError at ``path`` unless ``value`` is what ``metadata`` of a declared field allows."""
    kind = metadata["type"]
    if kind == "boolean":
        if not isinstance(value, bool):
            raise ParameterError(path, f"{value!r} is neither true nor false", "true | false")
    elif kind == "choice":
        if value not in metadata["options"]:
            raise ParameterError(path, f"{value!r} is not known", " | ".join(metadata["options"]))
    else:
        check_number(path, value, metadata["low"], metadata["high"], metadata["unit"], integer=kind == "integer")


@cache
def _declared(kind: Any) -> tuple[tuple[str, float, float, dataclasses.Field], ...]:
    """Name, range and declaration of the fields to check; only floats have a range."""
    found = []
    for spec in dataclasses.fields(kind):
        if "type" in spec.metadata:
            is_float = spec.metadata["type"] == "number"
            low, high = (spec.metadata["low"], spec.metadata["high"]) if is_float else (math.inf, -math.inf)
            found.append((spec.name, low, high, spec))
    return tuple(found)


def check_number(path: str, value: Any, low: float, high: float, unit: str = "", integer: bool = False) -> None:
    """Raise ParameterError unless ``value`` is a finite number in [low, high]."""
    if type(value) is float and low <= value <= high and not integer:
        return  # the usual case; every request has a hundred of them
    unit_text = f" {unit}" if unit and unit != "1" else ""
    allowed = f"{low:g} to {high:g}{unit_text}"
    if not is_number(value):
        raise ParameterError(path, f"{value!r} is not a number", allowed)
    if not abs(value) < math.inf:  # not isfinite: an int may be larger than any float
        raise ParameterError(path, f"{value!r} is not finite", allowed)
    if not low <= value <= high:
        shown = f"{value:g}" if abs(value) < sys.float_info.max else "a number beyond all floats"
        raise ParameterError(path, f"{shown} is out of range", allowed)
    if integer and value != int(value):
        raise ParameterError(path, f"{value!r} is not a whole number", allowed)


def is_number(value: Any) -> bool:
    """Whether a value is a real number; true and false are not."""
    return isinstance(value, Real) and not isinstance(value, bool)
