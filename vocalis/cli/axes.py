"""The sweep of a command line: axes as text, or a document in a file."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from vfcore.errors import ParameterError
from vfcore.runs.sweep.document import sweep_from_dict
from vfcore.runs.sweep.plan import Sweep
from vfcore.spec.request import document_of
from vfcore.spec.simulation import Simulation
from vocalis.cli.options import number_or_text
from vocalis.cli.requests import read_document

_ALLOWED = "PATH=FIRST:LAST:COUNT or PATH=V1,V2,…; PATH,PATH=… for tied parameters"
_MOST_OF_A_RANGE = 10**7


def sweep_of(
    base: Simulation, path: str | None, axes: Sequence[str], measures: str | None, precision: str | None
) -> Sweep:
    """The sweep of a document file, or of axes over ``base``; ParameterError for invalid input."""
    if (path is None) == (not axes):
        raise ParameterError("--axis", "is missing" if path is None else "cannot be combined with --sweep", _ALLOWED)
    document: dict[str, Any]
    if path is None:
        document = {"kind": "sweep", "base": document_of(base), "axes": [axis(text) for text in axes]}
    elif base != Simulation():
        raise ParameterError("--sweep", "cannot be combined with options of the base", "the base inside the document")
    else:
        document = read_document("--sweep", path)
    if measures is not None:
        document["measures"] = [key.strip() for key in measures.split(",") if key.strip()]
    if precision is not None:
        document["precision"] = precision
    return sweep_from_dict(document)


def axis(text: str) -> dict[str, Any]:
    """``activation.ct=0:1:21`` as an axis of a sweep document."""
    paths, separator, values = text.partition("=")
    names = [name.strip() for name in paths.split(",") if name.strip()]
    if not separator or not names or not values.strip():
        raise ParameterError("--axis", f"{text!r} is not an axis", _ALLOWED)
    return {"parameter": names[0] if len(names) == 1 else names, "values": _values(text, values)}


def _values(text: str, values: str) -> list[Any]:
    if ":" not in values:
        return [number_or_text(value.strip()) for value in values.split(",")]
    parts = [number_or_text(part.strip()) for part in values.split(":")]
    numbers = [part for part in parts if isinstance(part, int | float)]
    if not len(parts) == len(numbers) == 3:
        raise ParameterError("--axis", f"{text!r} is not a range", _ALLOWED)
    first, last, count = numbers
    if not isinstance(count, int) or not 1 <= count <= _MOST_OF_A_RANGE:
        raise ParameterError("--axis", f"{text!r} has no valid count", "a whole number of values, 1 or more")
    # Rounded to 0.15, not 0.15000000000000002.
    return [float(f"{value:.12g}") for value in np.linspace(first, last, count)]
