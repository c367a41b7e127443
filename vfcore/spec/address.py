"""The address of a result: a hash of what is computed, in one form, and of the versions that give it its meaning.

Two requests have one address exactly when they resolve to the same computation. So a computation names no variant and
no posture set: it holds the equations they stand for and every constant, overridden or not.
"""

import hashlib
import json
from functools import lru_cache
from typing import Any

from vfcore.spec.document import FOLD_NAMES, simulation_to_dict
from vfcore.spec.posture_sets import PosturingConstants, constant_names
from vfcore.spec.simulation import Simulation
from vfcore.version import ADDRESS_VERSION, MODEL_VERSION

WHOLE = ("nx", "ny")


def canonical(request: Simulation) -> dict[str, Any]:
    """The complete request document with every number in one form: equal requests are equal documents."""
    return _one_form(simulation_to_dict(request))


def computation(request: Simulation) -> dict[str, Any]:
    """What a request resolves to, with nothing left to a default: equal computations are equal documents."""
    document = canonical(request)
    model, variant = document.pop("model"), request.model.resolved()
    document["equations"] = {name: model[name] for name in ("coupling_gradient", "shear", "coupling")}
    document["airway_scale"] = variant.airway_scale
    fold = {name: getattr(request.constants, name) for name in FOLD_NAMES}
    document["constants"] = _one_form(fold) | _posturing(request.posturing)
    return document


@lru_cache(maxsize=64)
def _posturing(constants: PosturingConstants) -> dict[str, float]:
    return _one_form({name: constants.value(name) for name in constant_names()})


def address(request: Simulation) -> str:
    """Where the result of a request is kept."""
    return computation_address(computation(request))


def computation_address(computation: dict[str, Any], *more: Any) -> str:
    """The address of a computation, or of what else is asked of it."""
    digest = _digest(tuple(computation["constants"].values()))
    return content_hash([computation | {"constants": digest}, *more])


@lru_cache(maxsize=256)
def _digest(constants: tuple[float, ...]) -> str:
    """All constants in the order of ``computation`` as one: the points of a sweep mostly share them."""
    return content_hash(constants)


def content_hash(document: Any) -> str:
    """32 hexadecimal digits for a plain document under this version of the model and of addresses."""
    text = json.dumps(
        [MODEL_VERSION, ADDRESS_VERSION, document], sort_keys=True, separators=(",", ":"), allow_nan=False
    )
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def _one_form(value: Any, key: str = "") -> Any:
    if isinstance(value, dict):
        return {name: _one_form(item, name) for name, item in value.items()}
    if isinstance(value, bool) or not isinstance(value, int | float):
        return value
    return int(value) if key in WHOLE else float(value) + 0.0  # -0.0 is 0.0
