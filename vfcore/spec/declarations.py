"""What the fields of a request class declare, by dotted path: values, parts, and lists of objects."""

import dataclasses
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from types import MappingProxyType
from typing import Any, NamedTuple

from vfcore.spec.larynx import CONSTANTS, PAPER_LARYNX

#: The part of a request that holds the constants of the larynx.
LARYNX = "constants"
#: The patient's sides, and the parts of a request that hold what differs on them.
SIDES = ("left", "right")


class Declaration(NamedTuple):
    """One value of a request.

    ``part``: the path of the object it belongs to, empty at the top. ``default``: of the paper's modal case; None where
    the value may be null. ``optional``: the parts around it that may be null, the outermost first. ``metadata``: what
    vfcore.spec.fields attaches. ``per_side``: whether it may differ between the left and the right fold.
    """

    path: str
    part: str
    name: str
    default: Any
    optional: tuple[str, ...]
    metadata: Mapping[str, Any]
    per_side: bool

    @property
    def is_number(self) -> bool:
        return self.metadata["type"] in ("number", "integer")

    @property
    def is_whole(self) -> bool:
        return self.metadata["type"] == "integer"


class ListDeclaration(NamedTuple):
    """One list of objects of a request; see ``vfcore.spec.fields.parts``. ``rows``: the values of an object by name."""

    path: str
    kind: type
    label: str
    at_most: int
    help: str
    on_side: Callable[[tuple, str], tuple]
    rows: Mapping[str, Declaration]


@cache
def declarations_of(kind: Any) -> Mapping[str, Declaration]:
    """Every value of a request class by path, in the order of its fields, constants of the larynx last.

    Without the values of lists and of sides.
    """
    found = {row.path: row for row in _walk(kind, "", (), False)}
    if any(spec.name == "larynx" for spec in dataclasses.fields(kind)):
        for name, constant in CONSTANTS.items():
            path, per_side = f"{LARYNX}.{name}", not constant.metadata["common"]
            found[path] = Declaration(path, LARYNX, name, PAPER_LARYNX.value(name), (), constant.metadata, per_side)
    return MappingProxyType(found)


def _walk(kind: type, part: str, optional: tuple[str, ...], per_side: bool) -> Iterator[Declaration]:
    for spec in dataclasses.fields(kind):
        path = f"{part}.{spec.name}" if part else spec.name
        differs = per_side or spec.metadata.get("per_side", False)
        if "part" in spec.metadata:
            around = (*optional, path) if spec.metadata["optional"] else optional
            yield from _walk(spec.metadata["part"], path, around, differs)
        elif "type" in spec.metadata:
            differs = differs and not spec.metadata.get("common")
            yield Declaration(path, part, spec.name, spec.default, optional, spec.metadata, differs)


def parts_of(kind: type, part: str = "") -> dict[str, type]:
    """The objects of a request class by path, outer ones first, without larynx, sides and lists."""
    found: dict[str, type] = {}
    for spec in dataclasses.fields(kind):
        if "part" in spec.metadata:
            path = f"{part}.{spec.name}" if part else spec.name
            found |= {path: spec.metadata["part"]} | parts_of(spec.metadata["part"], path)
    return found


@cache
def lists_of(kind: Any) -> Mapping[str, ListDeclaration]:
    """The lists of objects of a request class by name."""
    found = {}
    for spec in dataclasses.fields(kind):
        if (item := spec.metadata.get("parts")) is not None:
            rows = {row.path: row for row in _walk(item, "", (), False)}
            about = {name: spec.metadata[name] for name in ("label", "at_most", "help", "on_side")}
            found[spec.name] = ListDeclaration(spec.name, item, rows=rows, **about)
    return MappingProxyType(found)


@cache
def optional_parts_of(kind: Any) -> frozenset[str]:
    """The parts of a request class that may be null, by path, without the sides."""
    return frozenset(part for row in declarations_of(kind).values() for part in row.optional)


def tree_of(patch: Mapping[str, Any]) -> dict[str, Any]:
    """Values by dotted path as a tree of dicts."""
    tree: dict[str, Any] = {}
    for path, value in patch.items():
        *parts, name = path.split(".")
        place = tree
        for part in parts:
            place = place.setdefault(part, {})
        place[name] = value
    return tree
