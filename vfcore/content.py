"""The address of a result: a hash of what was asked, in one canonical form, and of the model's version."""

import hashlib
import json
from typing import Any

from vfcore.params import Simulation
from vfcore.request import simulation_to_dict
from vfcore.version import MODEL_VERSION

WHOLE = ("nx", "ny")


def canonical(request: Simulation) -> dict[str, Any]:
    """The complete request document with every number in one form: equal requests are equal documents."""
    return _one_form(simulation_to_dict(request))


def content_hash(document: Any) -> str:
    """Address of the result of a canonical request under this version of the model, 32 hexadecimal digits."""
    text = json.dumps([MODEL_VERSION, document], sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def _one_form(value: Any, key: str = "") -> Any:
    if isinstance(value, dict):
        return {name: _one_form(item, name) for name, item in value.items()}
    if isinstance(value, bool) or not isinstance(value, int | float):
        return value
    return int(value) if key in WHOLE else float(value) + 0.0  # -0.0 is 0.0
