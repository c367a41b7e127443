"""Requests as patches and as documents, and the only place that resolves them.

A *patch* maps dotted paths to values: ``{"activation.ct": 0.5, "model.variant": "human"}``. It holds the changes to its
base, the larynx and the equations of a model variant. ``resolve`` turns a patch, or the same as a nested document, into
a ``Simulation``, in which every value is explicit. ``document_of`` and ``patch_of`` are the inverse.
"""

import dataclasses
from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Any

from vfcore.errors import ParameterError
from vfcore.spec.larynx import KNOWN_CONSTANTS, larynx_of
from vfcore.spec.paths import (
    DECLARATIONS,
    LARYNX,
    NAMES_IN,
    OPTIONAL_PARTS,
    PARTS,
    absent_parts,
    default_values,
    differing,
    one_form,
    value_at,
)
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
    """A patch with a later one on top. A null part in the later one removes its values, and values restore a null
    part.
    """
    gone = tuple(f"{part}." for part in OPTIONAL_PARTS if part in later and later[part] is None)
    back = {part for path in later for part in OPTIONAL_PARTS if path.startswith(f"{part}.")}
    kept = {path: value for path, value in patch.items() if not path.startswith(gone) and path not in back}
    return kept | dict(later)


def nested(patch: Mapping[str, Any]) -> dict[str, Any]:
    """The document of a patch, with an object for each part."""
    document: dict[str, Any] = {}
    for path, value in patch.items():
        *parts, name = path.split(".")
        place = document
        for part in parts:
            place = place.setdefault(part, {})
        place[name] = value
    return document


def patched(request: Simulation, patch: Mapping[str, Any]) -> Simulation:
    """``request`` with the values of a patch; ParameterError where they are inconsistent.

    A patch of the model starts again from the variant it names, and keeps what ``request`` changes in its own variant.
    """
    tree = nested(patch)
    if tree.keys() == {"activation"}:
        return request.with_activation(dataclasses.replace(request.activation, **tree["activation"]))
    if "model" in tree:
        return _built(merged(patch_of(request), patch))
    changes: dict[str, Any] = {}
    if constants := tree.pop(LARYNX, None):
        changes["larynx"] = request.larynx.override(constants)
    return dataclasses.replace(request, **changes, **_replacements(request, "", tree))


def _replacements(owner: Any, at: str, tree: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of ``owner``, the object at the path ``at``, with the values of a tree."""
    changes: dict[str, Any] = {}
    for name, value in tree.items():
        path = f"{at}.{name}" if at else name
        if path in PARTS and value is not None:
            old = getattr(owner, name)
            changes[name] = (
                _made(path, value) if old is None else dataclasses.replace(old, **_replacements(old, path, value))
            )
        else:
            changes[name] = value
    return changes


def _made(part: str, tree: Mapping[str, Any]) -> Any:
    """The object of a part with the values of a tree, the others at their defaults."""
    inner = {name: _made(f"{part}.{name}", value) if f"{part}.{name}" in PARTS and value is not None else value
             for name, value in tree.items()}  # fmt: skip
    return PARTS[part](**inner)


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
    return patch


def _base(variant: str) -> Simulation:
    return Simulation(model=Model(variant))


_PATHS = {part: tuple(row.path for row in DECLARATIONS.values() if row.part == part) for part in NAMES_IN}


def values_of(request: Simulation) -> dict[str, Any]:
    """Every value by path, constants included; ``{"posture": None}`` for an optional part that is not given."""
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
    tree = nested(patch)
    constants = tree.pop(LARYNX, {})
    values = {
        name: _made(name, value) if name in PARTS and value is not None else value for name, value in tree.items()
    }
    model = values.get("model") or Model()
    return Simulation(larynx=larynx_of(model.variant, model.posture_set).override(constants), **values)


def _leaves(document: Mapping[str, Any], at: str = "") -> Iterator[tuple[str, Any]]:
    """Every value of a document by path. ``at``: the part that the document is of, empty for a request."""
    for key, value in document.items():
        path = f"{at}.{key}" if at else str(key)
        if path in DECLARATIONS or (path in OPTIONAL_PARTS and value is None):
            yield path, value
        elif path in NAMES_IN and path:
            inside = _object(value, path)
            if not inside and path in OPTIONAL_PARTS:  # given, with every field at its default
                yield from default_values(path).items()
            yield from _leaves(inside, path)
        elif path == "kind":
            if value != KIND:
                raise ParameterError("kind", f"{value!r} is not a simulation", KIND)
        else:
            raise _unknown(path)


def _unknown(path: str) -> ParameterError:
    part, _, name = path.rpartition(".")
    if part == LARYNX:
        return ParameterError(path, "is not a constant of the model", KNOWN_CONSTANTS)
    if part not in NAMES_IN:
        part = ""
    inside = [other.rpartition(".")[2] for other in (*PARTS, LARYNX) if other.rpartition(".")[0] == part]
    known = [*NAMES_IN[part], *inside, *(() if part else ("kind",))]
    return ParameterError(path or "a field without a name", "is not a known field", ", ".join(sorted(known)))


def _object(value: Any, path: str) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        what = "null" if value is None else type(value).__name__
        raise ParameterError(path, f"{what} is not an object", _AN_OBJECT)
    return value
