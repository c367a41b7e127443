"""Every value that a request may set, by dotted path, read from the dataclasses that hold and validate the values.

A field added to one of them, or an optional part added to ``Simulation``, appears here, and through this module in
documents, patches, addresses, the schema, the command line, the server's bodies and the page.
"""

import dataclasses
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from vfcore.errors import ParameterError
from vfcore.spec.fields import check_value
from vfcore.spec.larynx import CONSTANTS, larynx_of
from vfcore.spec.simulation import Model, Simulation

#: The part of a request that holds the constants of the larynx.
LARYNX = "constants"


class Declaration(NamedTuple):
    """One value of a request.

    ``part``: the path of the object it belongs to, empty at the top. ``default``: of the paper's modal case; None where
    the value may be null. ``optional``: the parts around it that may be null, the outermost first. ``metadata``: what
    vfcore.spec.fields attaches.
    """

    path: str
    part: str
    name: str
    default: Any
    optional: tuple[str, ...]
    metadata: Mapping[str, Any]

    @property
    def is_number(self) -> bool:
        return self.metadata["type"] in ("number", "integer")

    @property
    def is_whole(self) -> bool:
        return self.metadata["type"] == "integer"


def declarations_of(kind: type) -> dict[str, Declaration]:
    """Every value of a request class by path, in the order of its fields, constants of the larynx last."""
    found = {row.path: row for row in _walk(kind, "", ())}
    if any(spec.name == "larynx" for spec in dataclasses.fields(kind)):
        paper = larynx_of(Model().variant, Model().posture_set)
        for name, constant in CONSTANTS.items():
            path = f"{LARYNX}.{name}"
            found[path] = Declaration(path, LARYNX, name, paper.value(name), (), constant.metadata)
    return found


def _walk(kind: type, part: str, optional: tuple[str, ...]) -> Iterator[Declaration]:
    for spec in dataclasses.fields(kind):
        path = f"{part}.{spec.name}" if part else spec.name
        if "part" in spec.metadata:
            around = (*optional, path) if spec.metadata["optional"] else optional
            yield from _walk(spec.metadata["part"], path, around)
        elif "type" in spec.metadata:
            yield Declaration(path, part, spec.name, spec.default, optional, spec.metadata)


def parts_of(kind: type, part: str = "") -> dict[str, type]:
    """The objects of a request class by path, outer ones first, without the constants of the larynx."""
    found: dict[str, type] = {}
    for spec in dataclasses.fields(kind):
        if "part" in spec.metadata:
            path = f"{part}.{spec.name}" if part else spec.name
            found |= {path: spec.metadata["part"]} | parts_of(spec.metadata["part"], path)
    return found


DECLARATIONS = declarations_of(Simulation)
PARTS = parts_of(Simulation)
OPTIONAL_PARTS = frozenset(part for row in DECLARATIONS.values() for part in row.optional)
#: Names of the values directly in each part, by its path; "" for the top.
NAMES_IN = {part: tuple(row.name for row in DECLARATIONS.values() if row.part == part) for part in ("", *PARTS, LARYNX)}
#: Every path of a number that a request may set or a sweep may vary.
NUMBERS = tuple(row.path for row in DECLARATIONS.values() if row.is_number)


def value_at(request: Simulation, path: str) -> Any:
    """The value at a path; None if it belongs to an optional part that is not given."""
    row = DECLARATIONS[path]
    part = part_of(request, row.part)
    if row.part == LARYNX:
        return part.value(row.name)
    return None if part is None else getattr(part, row.name)


def part_of(request: Simulation, part: str) -> Any:
    """One object of a request, None if it is not given; for ``constants``, the larynx; for "", the request."""
    if part == LARYNX:
        return request.larynx
    found: Any = request
    for name in part.split(".") if part else ():
        found = None if found is None else getattr(found, name)
    return found


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


def absent_parts(request: Simulation) -> tuple[str, ...]:
    """The optional parts that a request does not give; of parts within an absent part only the outer one."""
    absent: list[str] = []
    for part in PARTS:
        inside = any(part.startswith(f"{outer}.") for outer in absent)
        if part in OPTIONAL_PARTS and not inside and part_of(request, part) is None:
            absent.append(part)
    return tuple(absent)


def default_values(part: str) -> dict[str, Any]:
    """What an optional part holds that is given without any value: by path, null for optional parts within it."""
    inner = [other for other in OPTIONAL_PARTS if other.startswith(f"{part}.")]
    values: dict[str, Any] = {}
    for path, row in DECLARATIONS.items():
        if path.startswith(f"{part}."):
            hidden = next((other for other in row.optional if other in inner), None)
            values[path if hidden is None else hidden] = None if hidden else one_form(row, row.default)
    return values


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
    check_value(at, value, row.metadata)
    return one_form(row, value)


def one_form(row: Declaration, value: Any) -> Any:
    """The canonical form of a value: whole numbers as int, other numbers as float, no negative zero."""
    if value is None or not row.is_number:
        return value
    return int(value) if row.is_whole else float(value) + 0.0
