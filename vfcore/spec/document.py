"""A request document (plain dict, as in JSON) to a ``Simulation`` and back.

Unknown keys are refused with the keys that are known; every error carries the dotted path of
the field. ``constants`` holds overrides by name: of the fold (FoldConstants) or of the
posturing tables (``L_0_posture_m``, ``TA_sigma_max_active_pa``, …).
"""

import dataclasses
from collections.abc import Mapping
from typing import Any

from vfcore.errors import ParameterError
from vfcore.spec.fold_constants import FoldConstants
from vfcore.spec.posture_sets import PosturingConstants, constant_names, posture_set
from vfcore.spec.simulation import Activation, Model, PostureOverride, Run, Simulation
from vfcore.spec.variants import ModelVariant

FOLD_NAMES = tuple(field.name for field in dataclasses.fields(FoldConstants))
_TOP = (
    "kind",
    "activation",
    "subglottal_pressure_pa",
    "convergence_angle_rad",
    "vowel",
    "model",
    "posture",
    "run",
    "constants",
)


def simulation_from_dict(document: Mapping[str, Any]) -> Simulation:
    """Validate a request document; raise ParameterError for the first field that cannot be used."""
    document = _mapping(document, "request")
    _known(document, _TOP, "")
    if document.get("kind", "simulation") != "simulation":
        raise ParameterError("kind", f"{document['kind']!r} is not a simulation", "simulation")
    model = _part(Model, document, "model")
    variant = model.resolved()
    fold, posturing = _constants(document.get("constants", {}), variant, posture_set(variant.posture_set))
    values: dict[str, Any] = {
        "activation": _part(Activation, document, "activation"),
        "model": model,
        "posture": _part(PostureOverride, document, "posture") if document.get("posture") is not None else None,
        "run": _part(Run, document, "run"),
        "constants": fold,
        "posturing": posturing,
    }
    for key in ("subglottal_pressure_pa", "convergence_angle_rad", "vowel"):
        if key in document:
            values[key] = document[key]
    return Simulation(**values)


def simulation_to_dict(request: Simulation) -> dict[str, Any]:
    """The complete request document: every field, and the constants that differ from their set."""
    document: dict[str, Any] = {"kind": "simulation"}
    document["activation"] = dataclasses.asdict(request.activation)
    for key in ("subglottal_pressure_pa", "convergence_angle_rad", "vowel"):
        document[key] = getattr(request, key)
    document["model"] = dataclasses.asdict(request.model)
    document["posture"] = dataclasses.asdict(request.posture) if request.posture else None
    document["run"] = dataclasses.asdict(request.run)
    document["constants"] = _overrides(request)
    return document


def _overrides(request: Simulation) -> dict[str, float]:
    default = request.model.resolved().constants()
    changed = {
        name: getattr(request.constants, name)
        for name in FOLD_NAMES
        if getattr(request.constants, name) != getattr(default, name)
    }
    own = posture_set(request.model.resolved().posture_set)
    changed |= {
        name: request.posturing.value(name)
        for name in constant_names()
        if request.posturing.value(name) != own.value(name)
    }
    return changed


def _constants(
    overrides, variant: ModelVariant, posturing: PosturingConstants
) -> tuple[FoldConstants, PosturingConstants]:
    fold: dict[str, float] = {}
    muscles: dict[str, float] = {}
    names = constant_names()
    for name, value in _mapping(overrides, "constants").items():
        if name in FOLD_NAMES:
            fold[name] = value
        elif name in names:
            muscles[name] = value
        else:
            raise ParameterError(
                f"constants.{name}",
                "is not a constant of the model",
                "the names listed by `vocalis posture --constants` and by GET /api/v1/parameters",
            )
    return variant.constants(**fold), posturing.override_all(muscles)


def _part(kind, document: Mapping[str, Any], key: str):
    values = _mapping(document.get(key, {}), key)
    fields = {field.name for field in dataclasses.fields(kind)}
    _known(values, tuple(fields), f"{key}.")
    return kind(**values)


def _mapping(value, path: str) -> Mapping[str, Any]:
    if value is None:
        raise ParameterError(path, "null is not an object", "an object with named fields, or nothing at all")
    if not isinstance(value, Mapping):
        raise ParameterError(path, f"{type(value).__name__} is not an object", "an object with named fields")
    return value


def _known(values: Mapping[str, Any], names: tuple[str, ...], prefix: str) -> None:
    for key in values:
        if key not in names:
            raise ParameterError(f"{prefix}{key}", "is not a known field", ", ".join(sorted(names)))


def numeric_paths() -> tuple[str, ...]:
    """Every dotted path of a number that a request may set or a sweep may vary."""
    paths = [f"activation.{field.name}" for field in dataclasses.fields(Activation)]
    paths += ["subglottal_pressure_pa", "convergence_angle_rad"]
    paths += [f"posture.{field.name}" for field in dataclasses.fields(PostureOverride)]
    paths += ["run.duration_s", "run.nx", "run.ny", "run.time_step_s", "run.pressure_rise_s"]
    paths += [f"constants.{name}" for name in (*FOLD_NAMES, *constant_names())]
    return tuple(paths)


def with_numbers(base: Simulation, values: Mapping[str, float]) -> Simulation:
    """``base`` with the numbers at these paths; ParameterError where they do not go together."""
    changes: dict[str, Any] = {}
    parts: dict[str, dict[str, float]] = {}
    for path, value in values.items():
        part, _, name = path.rpartition(".")
        if part:
            parts.setdefault(part, {})[name] = value
        else:
            changes[name] = value
    for part in ("activation", "posture", "run"):
        if part in parts:
            old = getattr(base, part)
            changes[part] = PostureOverride(**parts[part]) if old is None else dataclasses.replace(old, **parts[part])
    if changes.keys() == {"activation"} and "constants" not in parts:
        return base.with_activation(changes["activation"])
    if constants := parts.get("constants"):
        fold = {name: value for name, value in constants.items() if name in FOLD_NAMES}
        muscles = {name: value for name, value in constants.items() if name not in FOLD_NAMES}
        if fold:
            changes["constants"] = dataclasses.replace(base.constants, **fold)
        if muscles:
            changes["posturing"] = base.posturing.override_all(muscles)
    return dataclasses.replace(base, **changes)
