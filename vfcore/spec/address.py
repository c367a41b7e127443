"""The address of a result: a hash of what is computed, and of the versions that give it its meaning.

Two requests have the same address exactly when they resolve to the same computation. A computation therefore names no
variant and no posturing set: it holds the equations they select and every constant, overridden or not.
"""

import hashlib
import json
from collections.abc import Mapping
from functools import lru_cache
from typing import Any, NamedTuple

from vfcore.spec.larynx import CONSTANTS
from vfcore.spec.paths import DECLARATIONS, LARYNX, default_values
from vfcore.spec.request import values_of
from vfcore.spec.simulation import Simulation
from vfcore.version import ADDRESS_VERSION, MODEL_VERSION

#: Names of published choices, left out because their values are among the constants.
NAMES_ONLY = ("model.variant", "model.posture_set")


class Computation(NamedTuple):
    """What a request resolves to.

    ``settings``: every value by path but those of the larynx. ``constants``: the larynx, in the order of CONSTANTS.
    """

    settings: Mapping[str, Any]
    constants: tuple[float, ...]

    def with_numbers(self, numbers: Mapping[str, float]) -> "Computation":
        """The computation of ``patched``, without building the request: a sweep needs one for every point."""
        settings, constants = dict(self.settings), self.constants
        changed: dict[str, float] = {}
        for path, value in numbers.items():
            part, _, name = path.rpartition(".")
            if part == LARYNX:
                changed[name] = value
                continue
            for optional in DECLARATIONS[path].optional:
                if settings.pop(optional, optional) is None:
                    settings |= default_values(optional)
            settings[path] = value
        if changed:
            constants = tuple(changed.get(name, value) for name, value in zip(CONSTANTS, constants, strict=True))
        return Computation(settings, constants)

    def address(self, *more: Any) -> str:
        """The address of its result; ``more`` says what else it depends on."""
        return content_hash([self.settings, _digest(self.constants), *more])


def computation(request: Simulation) -> Computation:
    """The computation that a request resolves to."""
    settings, constants = {}, []
    for path, value in values_of(request).items():
        if path.startswith(f"{LARYNX}."):
            constants.append(value)
        elif path not in NAMES_ONLY:
            settings[path] = value
    return Computation(settings, tuple(constants))


def address(request: Simulation) -> str:
    """The address of the result of a request."""
    return computation(request).address()


def content_hash(document: Any) -> str:
    """Hash of a plain document, the model version and the address version: 32 hexadecimal digits."""
    versions = [MODEL_VERSION, ADDRESS_VERSION]
    text = json.dumps([*versions, document], sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


@lru_cache(maxsize=256)
def _digest(constants: tuple[float, ...]) -> str:
    """Hash of the constants, cached: most points of a sweep share them."""
    return content_hash(constants)
