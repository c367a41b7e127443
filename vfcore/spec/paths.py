"""Every value that a request may set, by dotted path, read from the dataclasses that hold and validate the values.

A field added to one of them, or an optional part added to ``Simulation``, appears here, and through this module in
documents, patches, addresses, the schema, the command line, the server's bodies and the page.
"""

import dataclasses
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from vfcore.errors import ParameterError
from vfcore.spec.fields import check_value
from vfcore.spec.larynx import CONSTANTS, Larynx, larynx_of
from vfcore.spec.simulation import Model, Simulation

#: The part of a request that holds the constants of the larynx.
LARYNX = "constants"


class Declaration(NamedTuple):
    """One value of a request.

    ``part``: the object it belongs to, empty at the top. ``default``: of the paper's modal case; None where the value
    may be null. ``optional``: whether its part may be null. ``metadata``: what vfcore.spec.fields attaches.
    """

    path: str
    part: str
    name: str
    default: Any
    optional: bool
    metadata: Mapping[str, Any]

    @property
    def is_number(self) -> bool:
        return self.metadata["type"] in ("number", "integer")

    @property
    def is_whole(self) -> bool:
        return self.metadata["type"] == "integer"


def declarations_of(kind: type) -> dict[str, Declaration]:
    """Every value of a request class by path, in the order of its fields, constants of the larynx last."""
    return {row.path: row for row in _walk(kind)}


def _walk(kind: type) -> Iterator[Declaration]:
    for spec in dataclasses.fields(kind):
        if "part" in spec.metadata:
            for inner in dataclasses.fields(spec.metadata["part"]):
                path = f"{spec.name}.{inner.name}"
                yield Declaration(path, spec.name, inner.name, inner.default, spec.metadata["optional"], inner.metadata)
        elif "type" in spec.metadata:
            yield Declaration(spec.name, "", spec.name, spec.default, False, spec.metadata)
    if any(spec.name == "larynx" for spec in dataclasses.fields(kind)):
        paper = larynx_of(Model().variant, Model().posture_set)
        for name, constant in CONSTANTS.items():
            yield Declaration(f"{LARYNX}.{name}", LARYNX, name, paper.value(name), False, constant.metadata)


def parts_of(kind: type) -> dict[str, type]:
    """The objects of a request class by name, without the constants of the larynx."""
    return {spec.name: spec.metadata["part"] for spec in dataclasses.fields(kind) if "part" in spec.metadata}


DECLARATIONS = declarations_of(Simulation)
PARTS = parts_of(Simulation)
OPTIONAL_PARTS = frozenset(row.part for row in DECLARATIONS.values() if row.optional)
NAMES_IN = {part: tuple(row.name for row in DECLARATIONS.values() if row.part == part) for part in ("", *PARTS, LARYNX)}
#: Every path of a number that a request may set or a sweep may vary.
NUMBERS = tuple(row.path for row in DECLARATIONS.values() if row.is_number)


def value_at(request: Simulation, path: str) -> Any:
    """The value at a path; None if it belongs to an optional part that is not given."""
    row = DECLARATIONS[path]
    if row.part == LARYNX:
        return request.larynx.value(row.name)
    if not row.part:
        return getattr(request, row.name)
    part = getattr(request, row.part)
    return None if part is None else getattr(part, row.name)


def part_of(request: Simulation, name: str) -> Any:
    """One object of a request; for ``constants``, the larynx."""
    return request.larynx if name == LARYNX else getattr(request, name)


def differing(one: Simulation, other: Simulation, among: Mapping[str, tuple[str, ...]]) -> tuple[str, ...]:
    """The paths at which two requests differ. ``among``: the paths to look at, by part ("" for the top)."""
    return tuple(
        path
        for part, paths in among.items()
        if not part or _differ(part_of(one, part), part_of(other, part))
        for path in paths
        if value_at(one, path) != value_at(other, path)
    )


def _differ(one: Any, other: Any) -> bool:
    return one is not other and one != other


def number_of(path: Any, at: str) -> str:
    """``path`` if it is the path of a number; otherwise ParameterError at ``at``."""
    if not isinstance(path, str) or path not in DECLARATIONS or not DECLARATIONS[path].is_number:
        raise ParameterError(
            at,
            f"{path!r} is not a number of a request" if isinstance(path, str) else "is not the name of a number",
            "a dotted path such as activation.ct, subglottal_pressure_pa or constants.K_col_pa_m",
        )
    return path


def value_for(path: str, value: Any, at: str) -> Any:
    """``value`` in its canonical form at ``path``; ParameterError at ``at`` if it is not allowed."""
    row = DECLARATIONS[path]
    if value is not None or row.default is not None:
        check_value(at, value, row.metadata)
    return one_form(row, value)


def one_form(row: Declaration, value: Any) -> Any:
    """The canonical form of a value: whole numbers as int, other numbers as float, no negative zero."""
    if value is None or not row.is_number:
        return value
    return int(value) if row.is_whole else float(value) + 0.0


__all__ = [
    "DECLARATIONS", "LARYNX", "NAMES_IN", "NUMBERS", "OPTIONAL_PARTS", "PARTS", "Declaration", "Larynx",
    "declarations_of", "differing", "number_of", "one_form", "part_of", "parts_of", "value_at", "value_for",
]  # fmt: skip
