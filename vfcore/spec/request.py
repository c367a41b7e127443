"""Requests as patches and as documents, and the only place that resolves them.

A *patch* maps dotted paths to values: ``{"activation.ct": 0.5, "model.variant": "human"}``. It holds the changes to its
base, the larynx and the equations of a model variant. ``resolve`` turns a patch, or the same as a nested document, into
a ``Simulation``, in which every value is explicit. ``document_of`` and ``patch_of`` are the inverse.

A side is a patch within a patch: ``right.activation.ta``. A list of a document replaces the list of the base: its patch
holds the list at its own path, empty, and the values of its objects, ``lesions.0.height_mm``. Such a path alone changes
one object, or adds one at the end.
"""

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from types import MappingProxyType
from typing import Any

from vfcore.errors import ParameterError
from vfcore.spec.declarations import SIDES, tree_of
from vfcore.spec.fields import made
from vfcore.spec.larynx import larynx_of
from vfcore.spec.paths import (
    DECLARATIONS,
    LARYNX,
    LISTS,
    NAMES_IN,
    OPTIONAL_PARTS,
    absent_parts,
    declaration_of,
    default_values,
    differing,
    item_of,
    names_known_in,
    one_form,
    unknown,
    value_at,
)
from vfcore.spec.sides import Side, side_of
from vfcore.spec.simulation import Model, Simulation

KIND = "simulation"
_AN_OBJECT = "an object with named fields"


def resolve(asked: Mapping[str, Any] = MappingProxyType({})) -> Simulation:
    """The request of a patch or a request document; values not given are those of the paper's modal case.

    Raises ParameterError with the path of the first value that cannot be used.
    """
    return _built(flat(asked))


def flat(asked: Any, at: str = "request") -> dict[str, Any]:
    """A patch from a patch, a document or a mixture; paths are checked, ranges are not.

    An optional part that is null becomes ``{"posture": None}``. Raises ParameterError for an unknown field, for null
    in place of an object, and for a value that is given twice.
    """
    patch: dict[str, Any] = {}
    for path, value in _leaves(_object(asked, at)):
        if path in patch:
            raise ParameterError(path, "is given twice", "one value")
        patch[path] = value
    for part in OPTIONAL_PARTS & patch.keys():
        if any(path.startswith(f"{part}.") for path in patch):
            raise ParameterError(part, "is null and has values", "null, or an object with named fields")
    return patch


def merged(patch: Mapping[str, Any], later: Mapping[str, Any]) -> dict[str, Any]:
    """A patch with a later one on top. A null part or a list in the later one removes its values, and values restore a
    null part.
    """
    gone = tuple(f"{part}." for part in OPTIONAL_PARTS if part in later and later[part] is None)
    gone += tuple(f"{name}." for name in LISTS if name in later)
    back = {part for path in later for part in OPTIONAL_PARTS if path.startswith(f"{part}.")}
    kept = {path: value for path, value in patch.items() if not path.startswith(gone) and path not in back}
    return kept | dict(later)


def nested(patch: Mapping[str, Any]) -> dict[str, Any]:
    """The document of a patch, with an object for each part and a list for each list.

    Raises ParameterError for an object of a list without those before it.
    """
    plain = {path: value for path, value in patch.items() if path not in LISTS}
    document = tree_of(plain)
    for name in LISTS:
        if name in document:
            document[name] = _in_order(name, document[name])
        elif name in patch:
            document[name] = patch[name]
    return document


def _in_order(name: str, items: Mapping[str, Any]) -> list[Any]:
    """The objects of a list, given by position."""
    for k in range(len(items)):
        if str(k) not in items:
            last = max(items, key=int)
            raise ParameterError(f"{name}.{last}", f"is given without {name}.{k}", "objects in order, from 0")
    return [items[str(k)] for k in range(len(items))]


def patched(request: Simulation, patch: Mapping[str, Any]) -> Simulation:
    """``request`` with the values of a patch; ParameterError where they are inconsistent.

    A patch of the model starts again from the variant it names, and keeps what ``request`` changes in its own variant.
    """
    if any(path.startswith("model.") for path in patch):
        return _built(merged(patch_of(request), patch))
    own: dict[str, Any] = {}
    beyond: dict[str, dict[str, Any]] = {}
    for path, value in patch.items():
        first, _, rest = path.partition(".")
        if first in SIDES or first in LISTS:
            beyond.setdefault(first, {})[rest] = value
        else:
            own[path] = value
    fields = {
        name: _side(getattr(request, name), values) if name in SIDES else _items(request, name, values)
        for name, values in beyond.items()
    }
    return request.with_values(tree_of(own), **fields)


def _side(side: Side | None, patch: Mapping[str, Any]) -> Side | None:
    """A side with the values of a patch by their paths within it; at "": the side as a whole, null."""
    before = {} if side is None or "" in patch else dict(side.values)
    return side_of(merged(before, {path: value for path, value in patch.items() if path}))


def _items(request: Simulation, name: str, patch: Mapping[str, Any]) -> tuple:
    """A list with the values of a patch by position and name; at "": the list as a whole, emptied first."""
    items = [] if "" in patch else list(getattr(request, name))
    trees = tree_of({path: value for path, value in patch.items() if path})
    for position in sorted(trees, key=int):
        k = int(position)
        if k > len(items):
            raise ParameterError(f"{name}.{k}", f"is given without {name}.{len(items)}", "objects in order, from 0")
        given = trees[position] if k == len(items) else _given(items[k]) | trees[position]
        items[k : k + 1] = [_item(name, k, given)]
    return tuple(items)


def _item(name: str, k: int, values: Mapping[str, Any]) -> Any:
    try:
        return made(LISTS[name].kind, values)
    except ParameterError as error:
        raise ParameterError(f"{name}.{k}.{error.path}", error.message, error.allowed) from error


def _given(item: Any) -> dict[str, Any]:
    """The shortest values that make an object of a list: its choices, and the numbers that do not follow from them."""
    choices = {spec.name: getattr(item, spec.name) for spec in dataclasses.fields(item) if spec.default is not None}
    usual = type(item)(**choices)
    defaults = type(item)()
    return {
        spec.name: getattr(item, spec.name)
        for spec in dataclasses.fields(item)
        if getattr(item, spec.name) != getattr(defaults if spec.name in choices else usual, spec.name)
    }


def patch_of(request: Simulation) -> dict[str, Any]:
    """The shortest patch that resolves to a request: the name of its variant, and the values that differ from it."""
    base = _base(request.model.variant)
    patch = {} if request.model.variant == Model().variant else {"model.variant": request.model.variant}
    if request.model.posture_set != base.model.posture_set:
        base = dataclasses.replace(base, larynx=larynx_of(request.model.variant, request.model.posture_set))
    absent = tuple(f"{part}." for part in absent_parts(request))
    different = set(differing(request, base, _PATHS))
    for path, row in DECLARATIONS.items():
        # A given optional part is named in full.
        if (row.optional or path in different) and not path.startswith(absent):
            patch[path] = value_at(request, path)
    return patch | _side_values(request) | _item_values(request)


def _side_values(request: Simulation) -> dict[str, Any]:
    """The values of sides by path."""
    found: dict[str, Any] = {}
    for name in SIDES:
        side = getattr(request, name)
        for path, value in () if side is None else side.values:
            full = f"{name}.{path}"
            row = declaration_of(full)
            found[full] = value if row is None else one_form(row, value)
    return found


def _item_values(request: Simulation) -> dict[str, Any]:
    """The shortest values of the objects of lists by path."""
    found: dict[str, Any] = {}
    for name, row in LISTS.items():
        for k, item in enumerate(getattr(request, name)):
            given = _given(item) or {next(iter(row.rows)): getattr(item, next(iter(row.rows)))}
            found |= {f"{name}.{k}.{value}": given[value] for value in given}
    return found


def _base(variant: str) -> Simulation:
    return Simulation(model=Model(variant))


_PATHS = {part: tuple(row.path for row in DECLARATIONS.values() if row.part == part) for part in NAMES_IN}


def values_of(request: Simulation) -> dict[str, Any]:
    """Every value by path, constants included; ``{"posture": None}`` for an optional part that is not given.

    Of a side the values that it gives, null where it gives none; of a list every value of its objects, and the empty
    list at its own path.
    """
    values = own_values_of(request)
    values |= {side: None for side in SIDES if getattr(request, side) is None} | _side_values(request)
    for name, of in LISTS.items():
        values[name] = []
        for k, item in enumerate(getattr(request, name)):
            values |= {f"{name}.{k}.{row.name}": one_form(row, getattr(item, row.name)) for row in of.rows.values()}
    return values


def own_values_of(request: Simulation) -> dict[str, Any]:
    """Every declared value by path, without those of sides and lists."""
    absent = absent_parts(request)
    hidden = tuple(f"{part}." for part in absent)
    values: dict[str, Any] = dict.fromkeys(absent)
    for path, row in DECLARATIONS.items():
        if row.part == LARYNX:
            break  # the last part
        if not path.startswith(hidden):
            values[path] = one_form(row, value_at(request, path))
    return values | {f"{LARYNX}.{name}": float(value) + 0.0 for name, value in request.larynx.values().items()}


def document_of(request: Simulation) -> dict[str, Any]:
    """The complete request document: every field, and the constants that differ from the variant's.

    Numbers are in canonical form, so equal requests give equal documents.
    """
    own = larynx_of(request.model.variant, request.model.posture_set)
    values = {path: value for path, value in values_of(request).items() if not path.startswith(f"{LARYNX}.")}
    document = {"kind": KIND} | nested(values)
    document[LARYNX] = dict(_differing_constants(request, own))
    return document


def _differing_constants(request: Simulation, own: Any) -> Iterator[tuple[str, float]]:
    if request.larynx == own:
        return
    published = own.values()
    for name, value in request.larynx.values().items():
        if value != published[name]:
            yield name, float(value) + 0.0


def _built(patch: Mapping[str, Any]) -> Simulation:
    of_model = {path: value for path, value in patch.items() if path.startswith("model.")}
    model = made(Model, tree_of(of_model).get("model", {}))
    return patched(_base_of(model), {path: value for path, value in patch.items() if path not in of_model})


@lru_cache(maxsize=64)
def _base_of(model: Model) -> Simulation:
    return Simulation(model=model)


def _leaves(document: Mapping[str, Any], at: str = "") -> Iterator[tuple[str, Any]]:
    """Every value of a document by path. ``at``: the part that the document is of, empty for a request."""
    for key, value in document.items():
        path = f"{at}.{key}" if at else str(key)
        if declaration_of(path) is not None or (path in OPTIONAL_PARTS and value is None):
            yield path, value
        elif path in LISTS:
            yield from _of_list(path, value)
        elif path and names_known_in(path):
            inside = _object(value, path)
            if not inside and (path in OPTIONAL_PARTS or item_of(path) is not None):
                yield from default_values(path).items()  # given, with every field at its default
            yield from _leaves(inside, path)
        elif path == "kind":
            if value != KIND:
                raise ParameterError("kind", f"{value!r} is not a simulation", KIND)
        else:
            raise unknown(path)


def _of_list(path: str, value: Any) -> Iterator[tuple[str, Any]]:
    """The values of a list of a document."""
    row = LISTS[path]
    if isinstance(value, Mapping):  # some objects by position, {"0": {"height_mm": 1}}
        yield from _leaves(value, path)
        return
    if isinstance(value, str) or not isinstance(value, Sequence):
        what = "null" if value is None else type(value).__name__
        raise ParameterError(path, f"{what} is not a list", f"a list of up to {row.at_most} objects")
    if len(value) > row.at_most:
        raise ParameterError(path, f"{len(value)} are too many", f"up to {row.at_most}")
    yield path, []  # takes the place of the objects before
    yield from _leaves({f"{path}.{k}": item for k, item in enumerate(value)})


def _object(value: Any, path: str) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        what = "null" if value is None else type(value).__name__
        raise ParameterError(path, f"{what} is not an object", _AN_OBJECT)
    return value
