"""One declaration per number: unit, label, range, source and help travel with the field.

The parameter schema, the validator, the command line's help and docs/model.md all read
the metadata that ``quantity`` attaches to a dataclass field.
"""

import dataclasses
import math
import sys
from functools import cache
from numbers import Real

from vfcore.errors import ParameterError

PAPER = "Serry, Zañartu & Peterson (2026)"


def quantity(
    default: float,
    unit: str,
    label: str,
    low: float,
    high: float,
    *,
    source: str,
    help: str = "",
    symbol: str = "",
    step: float | None = None,
):
    """A float field of a frozen dataclass, valid on the closed interval [low, high]."""
    return dataclasses.field(
        default=default,
        metadata={
            "unit": unit,
            "label": label,
            "low": low,
            "high": high,
            "source": source,
            "help": help,
            "symbol": symbol,
            "step": step,
        },
    )


def choice(default: str | None, label: str, options: tuple[str, ...], *, source: str, help: str = ""):
    """A string field that takes one of ``options``."""
    return dataclasses.field(
        default=default,
        metadata={"label": label, "options": options, "source": source, "help": help},
    )


def flag(default: bool, label: str, *, source: str, help: str = ""):
    """A field that is true or false."""
    return dataclasses.field(default=default, metadata={"label": label, "flag": True, "source": source, "help": help})


def validate(instance, prefix: str = "") -> None:
    """Check every declared field of a dataclass; raise ParameterError for the first bad one."""
    for name, low, high, spec in _declared(type(instance)):
        value = getattr(instance, name)
        if type(value) is float and low <= value <= high:  # what nearly every value is: not NaN, and in range
            continue
        path = f"{prefix}{name}"
        if "flag" in spec.metadata:
            if not isinstance(value, bool):
                raise ParameterError(path, f"{value!r} is neither true nor false", "true | false")
        elif "options" in spec.metadata:
            options = spec.metadata["options"]
            if value not in options and not (value is None and spec.default is None):
                raise ParameterError(path, f"{value!r} is not known", " | ".join(options))
        else:
            check_number(path, value, low, high, spec.metadata["unit"])


@cache
def _declared(kind: type) -> tuple[tuple[str, float, float, dataclasses.Field], ...]:
    """Name, range and declaration of the fields to check; a field that is no number has an empty range."""
    return tuple(
        (spec.name, spec.metadata.get("low", math.inf), spec.metadata.get("high", -math.inf), spec)
        for spec in dataclasses.fields(kind)
        if spec.metadata
    )


def check_number(path: str, value, low: float, high: float, unit: str = "", integer: bool = False) -> None:
    """Raise ParameterError unless ``value`` is a finite number in [low, high]."""
    if type(value) is float and low <= value <= high and not integer:
        return  # nearly always; a hundred of them stand in every request
    unit_text = f" {unit}" if unit and unit != "1" else ""
    allowed = f"{low:g} to {high:g}{unit_text}"
    if isinstance(value, bool) or not isinstance(value, Real):
        raise ParameterError(path, f"{value!r} is not a number", allowed)
    if not abs(value) < math.inf:  # not isfinite: an int may be larger than any float
        raise ParameterError(path, f"{value!r} is not finite", allowed)
    if not low <= value <= high:
        shown = f"{value:g}" if abs(value) < sys.float_info.max else "a number beyond all floats"
        raise ParameterError(path, f"{shown} is out of range", allowed)
    if integer and value != int(value):
        raise ParameterError(path, f"{value!r} is not a whole number", allowed)
