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
from vfcore.spec.paths import DECLARATIONS, LARYNX, NAMES_IN, OPTIONAL_PARTS, PARTS, differing, one_form, value_at
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


def nested(patch: Mapping[str, Any]) -> dict[str, Any]:
    """The document of a patch, with an object for each part."""
    document: dict[str, Any] = {}
    for path, value in patch.items():
        part, _, name = path.rpartition(".")
        (document.setdefault(part, {}) if part else document)[name] = value
    return document


def patched(request: Simulation, patch: Mapping[str, Any]) -> Simulation:
    """``request`` with the values of a patch; ParameterError where they are inconsistent.

    A patch of the model starts again from the variant it names, and keeps what ``request`` changes in its own variant.
    """
    by_part: dict[str, dict[str, Any]] = {}
    for path, value in patch.items():
        part, _, name = path.rpartition(".")
        by_part.setdefault(part, {})[name] = value
    if by_part.keys() == {"activation"}:
        return request.with_activation(dataclasses.replace(request.activation, **by_part["activation"]))
    if "model" in by_part:
        kept = {path: value for path, value in patch_of(request).items() if path.partition(".")[0] not in patch}
        return _built(kept | dict(patch))
    changes: dict[str, Any] = by_part.pop("", {})
    if constants := by_part.pop(LARYNX, None):
        changes["larynx"] = request.larynx.override(constants)
    for part, values in by_part.items():
        old = getattr(request, part)
        changes[part] = PARTS[part](**values) if old is None else dataclasses.replace(old, **values)
    return dataclasses.replace(request, **changes)


def patch_of(request: Simulation) -> dict[str, Any]:
    """The shortest patch that resolves to a request: the name of its variant, and the values that differ from it."""
    base = _base(request.model.variant)
    patch = {} if request.model.variant == Model().variant else {"model.variant": request.model.variant}
    if request.model.posture_set != base.model.posture_set:
        base = dataclasses.replace(base, larynx=larynx_of(request.model.variant, request.model.posture_set))
    given = tuple(part for part in OPTIONAL_PARTS if getattr(request, part) is not None)
    patch |= {
        path: value_at(request, path) for path in differing(request, base, _PATHS) if path.split(".")[0] not in given
    }
    return patch | {f"{part}.{name}": value_at(request, f"{part}.{name}") for part in given for name in NAMES_IN[part]}


def _base(variant: str) -> Simulation:
    return Simulation(model=Model(variant))


_PATHS = {part: tuple(row.path for row in DECLARATIONS.values() if row.part == part) for part in NAMES_IN}


def values_of(request: Simulation) -> dict[str, Any]:
    """Every value by path, constants included; ``{"posture": None}`` for an optional part that is not given."""
    values: dict[str, Any] = {}
    for path, row in DECLARATIONS.items():
        if row.part == LARYNX:
            break  # the last part
        if row.part in OPTIONAL_PARTS and getattr(request, row.part) is None:
            values[row.part] = None
        else:
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
    by_part: dict[str, dict[str, Any]] = {}
    for path, value in patch.items():
        part, _, name = path.rpartition(".")
        by_part.setdefault(part, {})[name] = value
    top = by_part.pop("", {})
    constants = by_part.pop(LARYNX, {})
    parts = {
        name: PARTS[name](**by_part.get(name, {})) for name in PARTS if name not in OPTIONAL_PARTS or name in by_part
    }
    model = parts["model"]
    larynx = larynx_of(model.variant, model.posture_set).override(constants)
    return Simulation(larynx=larynx, **top | parts)


def _leaves(document: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    for key, value in document.items():
        if key in DECLARATIONS:
            yield key, value
        elif key in OPTIONAL_PARTS and value is None:
            yield key, None
        elif key in NAMES_IN and key:
            inside = _object(value, key)
            if not inside and key in OPTIONAL_PARTS:  # given, with every field at its default
                inside = {name: DECLARATIONS[f"{key}.{name}"].default for name in NAMES_IN[key]}
            for name, inner in inside.items():
                if name not in NAMES_IN[key]:
                    _refuse(key, name)
                yield f"{key}.{name}", inner
        elif key == "kind":
            if value != KIND:
                raise ParameterError("kind", f"{value!r} is not a simulation", KIND)
        else:
            part, _, name = str(key).rpartition(".")
            _refuse(part, name) if part in NAMES_IN else _refuse("", str(key))


def _refuse(part: str, name: str) -> None:
    if part == LARYNX:
        raise ParameterError(f"{LARYNX}.{name}", "is not a constant of the model", KNOWN_CONSTANTS)
    known = NAMES_IN[part] if part else ("kind", *NAMES_IN[""], *PARTS, LARYNX)
    raise ParameterError(f"{part}.{name}" if part else name, "is not a known field", ", ".join(sorted(known)))


def _object(value: Any, path: str) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        what = "null" if value is None else type(value).__name__
        raise ParameterError(path, f"{what} is not an object", _AN_OBJECT)
    return value
