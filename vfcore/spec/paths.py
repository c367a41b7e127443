"""Every value that a request may set, by dotted path, read from the dataclasses that hold and validate the values.

A field added to one of them, or an optional part or a list added to ``Simulation``, appears here, and through this
module in documents, patches, addresses, the schema, the command line, the server's bodies and the page.

Three forms of path: that of a declared value, ``activation.ta``; the same on one side, ``right.activation.ta``, where
the value may differ between the sides; and that of a value of an object in a list, ``lesions.0.height_mm``.
"""

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from vfcore.errors import ParameterError
from vfcore.spec.declarations import (
    LARYNX,
    SIDES,
    Declaration,
    declarations_of,
    lists_of,
    optional_parts_of,
    parts_of,
)
from vfcore.spec.fields import check_value
from vfcore.spec.larynx import KNOWN_CONSTANTS
from vfcore.spec.sides import fold_on, not_per_side
from vfcore.spec.simulation import Simulation

#: Every declared value by path, without those of sides and lists.
DECLARATIONS = declarations_of(Simulation)
PARTS = parts_of(Simulation)
#: The lists of objects by path.
LISTS = lists_of(Simulation)
#: Every part of a request that may be null, sides and parts of sides included.
OPTIONAL_PARTS = optional_parts_of(Simulation) | frozenset(SIDES)
OPTIONAL_PARTS |= {
    f"{side}.{part}"
    for side in SIDES
    for part in optional_parts_of(Simulation)
    if any(row.per_side for row in DECLARATIONS.values() if part in row.optional)
}
#: Names of the values directly in each part, by its path; "" for the top.
NAMES_IN = {part: tuple(row.name for row in DECLARATIONS.values() if row.part == part) for part in ("", *PARTS, LARYNX)}
#: Every path of a number but those of sides and lists.
NUMBERS = tuple(row.path for row in DECLARATIONS.values() if row.is_number)
#: Every path of a number of sides and lists.
NUMBERS_BEYOND = (
    *(f"{side}.{path}" for side in SIDES for path in NUMBERS if DECLARATIONS[path].per_side),
    *(f"{name}.{k}.{value}" for name, of in LISTS.items() for k in range(of.at_most)
      for value, row in of.rows.items() if row.is_number),
)  # fmt: skip


@lru_cache(maxsize=4096)
def declaration_of(path: str) -> Declaration | None:
    """What is declared at a path of any form; None for no path of a value."""
    if (row := DECLARATIONS.get(path)) is not None:
        return row
    first, _, rest = path.partition(".")
    if first in SIDES:
        row = DECLARATIONS.get(rest)
        if row is None or not row.per_side:
            return None
        part = f"{first}.{row.part}" if row.part else first
        return Declaration(path, part, row.name, row.default, tuple(f"{first}.{outer}" for outer in row.optional),
                           {**row.metadata, "label": f"{row.metadata['label']}, {first} fold"}, True)  # fmt: skip
    if (item := item_of(path)) is not None and item[2] in LISTS[item[0]].rows:
        of, k, name = item
        row = LISTS[of].rows[name]
        label = f"{row.metadata['label']}, {of} {k}"
        return Declaration(path, f"{of}.{k}", name, row.default, (), {**row.metadata, "label": label}, False)
    return None


def known_declaration(path: str) -> Declaration:
    """What is declared at a path of any form; ParameterError for no path of a value."""
    row = declaration_of(path)
    if row is None:
        raise unknown(path)
    return row


def item_of(path: str) -> tuple[str, int, str] | None:
    """List, position and the rest of the path of (a value of) an object in a list; None for other paths."""
    of, _, rest = path.partition(".")
    number, _, name = rest.partition(".")
    if of not in LISTS or not (number.isascii() and number.isdigit()) or number != str(int(number)):
        return None
    return (of, int(number), name) if int(number) < LISTS[of].at_most else None


def value_at(request: Simulation, path: str) -> Any:
    """The value in force at a path of any form; None if it belongs to an optional part or an object not given."""
    first, _, rest = path.partition(".")
    if first in SIDES:
        return value_at(fold_on(request, first), rest)
    if first in LISTS:
        item = part_of(request, path.rpartition(".")[0])
        return None if item is None else getattr(item, path.rpartition(".")[2])
    row = DECLARATIONS[path]
    part = part_of(request, row.part)
    if row.part == LARYNX:
        return part.value(row.name)
    return None if part is None else getattr(part, row.name)


def part_of(request: Simulation, part: str) -> Any:
    """One object of a request, None if it is not given: a part, "" for the request, ``constants`` for the larynx,
    ``left.posture`` for what is in force on that side, ``lesions.0`` for an object of a list.
    """
    first, _, rest = part.partition(".")
    if first in SIDES and rest:
        return part_of(fold_on(request, first), rest)
    if first in LISTS and rest:
        items = getattr(request, first)
        return items[int(rest)] if int(rest) < len(items) else None
    if part == LARYNX:
        return request.larynx
    found: Any = request
    for name in part.split(".") if part else ():
        found = None if found is None else getattr(found, name)
    return found


def differing(one: Simulation, other: Simulation, among: Mapping[str, tuple[str, ...]]) -> tuple[str, ...]:
    """The declared paths at which two requests differ. ``among``: the paths to look at, by part ("" for the top)."""
    return tuple(
        path
        for part, paths in among.items()
        if not part or _differ(part_of(one, part), part_of(other, part))
        for path in paths
        if value_at(one, path) != value_at(other, path)
    )


def differing_beyond(one: Simulation, other: Simulation) -> tuple[str, ...]:
    """The paths of sides and lists at which two requests differ: values that only one gives, or that are not equal."""
    found: list[str] = []
    for side in SIDES:
        mine, others = getattr(one, side), getattr(other, side)
        if mine != others:
            pairs = {pair for own in (mine, others) if own is not None for pair in own.values}
            same = pairs.intersection(*(own.values if own is not None else () for own in (mine, others)))
            found += (f"{side}.{path}" for path in sorted({path for path, _ in pairs - same}))
    for name, row in LISTS.items():
        mine, others = getattr(one, name), getattr(other, name)
        if mine != others:
            paths = (f"{name}.{k}.{value}" for k in range(max(len(mine), len(others))) for value in row.rows)
            found += (path for path in paths if value_at(one, path) != value_at(other, path))
    return tuple(found)


def _differ(one: Any, other: Any) -> bool:
    return one is not other and one != other


def absent_parts(request: Simulation) -> tuple[str, ...]:
    """The declared optional parts that a request does not give; of parts within an absent part only the outer one."""
    absent: list[str] = []
    for part in PARTS:
        inside = any(part.startswith(f"{outer}.") for outer in absent)
        if part in OPTIONAL_PARTS and not inside and part_of(request, part) is None:
            absent.append(part)
    return tuple(absent)


def default_values(part: str) -> dict[str, Any]:
    """What an optional part or an object of a list holds that is given without any value: by path, null for optional
    parts within it.
    """
    first, _, rest = part.partition(".")
    if first in SIDES:
        return {f"{first}.{path}": value for path, value in default_values(rest).items()} if rest else {}
    if first in LISTS:
        return {f"{part}.{name}": one_form(row, row.default) for name, row in LISTS[first].rows.items()}
    inner = [other for other in OPTIONAL_PARTS if other.startswith(f"{part}.")]
    values: dict[str, Any] = {}
    for path, row in DECLARATIONS.items():
        if path.startswith(f"{part}."):
            hidden = next((other for other in row.optional if other in inner), None)
            values[path if hidden is None else hidden] = None if hidden else one_form(row, row.default)
    return values


@lru_cache(maxsize=1024)
def names_known_in(part: str) -> tuple[str, ...]:
    """Names of what is directly in a part of a request, "" for the request itself, or in an object of a list; none for
    other paths.
    """
    first, _, inner = part.partition(".")
    if first in LISTS:
        item = item_of(part)
        return tuple(LISTS[first].rows) if item is not None and not item[2] else ()
    on_side = first in SIDES
    within = f"{inner if on_side else part}.".removeprefix(".")
    paths = (path for path, row in DECLARATIONS.items() if path.startswith(within) and (row.per_side or not on_side))
    names = tuple(dict.fromkeys(path.removeprefix(within).partition(".")[0] for path in paths))
    return names if part else (*names, *SIDES, *LISTS)


def unknown(path: str) -> ParameterError:
    """The error for a path that a request does not have."""
    if (common := common_to_both_sides(path)) is not None:
        return common
    first, _, rest = path.partition(".")
    if first in LISTS and rest and item_of(path) is None:
        return ParameterError(path, "is not a known field", f"{first}.0 to {first}.{LISTS[first].at_most - 1}")
    part, _, name = path.rpartition(".")
    if part.rpartition(".")[2] == LARYNX and names_known_in(part):
        return ParameterError(path, "is not a constant of the model", KNOWN_CONSTANTS)
    while part and not names_known_in(part):
        part = part.rpartition(".")[0]
    known = sorted((*names_known_in(part), *(() if part else ("kind",))))
    return ParameterError(path or "a field without a name", "is not a known field", ", ".join(known))


def common_to_both_sides(path: str) -> ParameterError | None:
    """The error for a path on one side of what both sides share; None for other paths."""
    first, _, rest = path.partition(".")
    inside = [row for row in DECLARATIONS.values() if row.path == rest or row.path.startswith(f"{rest}.")]
    if first in SIDES and rest.partition(".")[0] in LISTS:
        return ParameterError(path, "is a list of the request, not of a side", f"{rest}, where each has its side")
    if first not in SIDES or not rest or not inside or any(row.per_side for row in inside):
        return None
    return not_per_side(first, rest, inside[0].metadata.get("common", "") if len(inside) == 1 else "")


def number_of(path: Any, at: str) -> str:
    """``path`` if it is the path of a number; otherwise ParameterError at ``at``."""
    row = declaration_of(path) if isinstance(path, str) else None
    if row is None or not row.is_number:
        if isinstance(path, str) and (common := common_to_both_sides(path)) is not None:
            raise ParameterError(at, f"{path} {common.message}", common.allowed)
        raise ParameterError(
            at,
            f"{path!r} is not a number of a request" if isinstance(path, str) else "is not the name of a number",
            "a dotted path such as activation.ct, right.activation.ct, lesions.0.height_mm or constants.K_col_pa_m",
        )
    return path


def value_for(path: str, value: Any, at: str) -> Any:
    """``value`` in its canonical form at the path of a value; ParameterError at ``at`` if it is not allowed."""
    row = known_declaration(path)
    check_value(at, value, row.metadata)
    return one_form(row, value)


def one_form(row: Declaration, value: Any) -> Any:
    """The canonical form of a value: whole numbers as int, other numbers as float, no negative zero."""
    if value is None or not row.is_number:
        return value
    return int(value) if row.is_whole else float(value) + 0.0
