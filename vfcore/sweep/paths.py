"""Numbers of a request by their dotted path: what they may be, and how a request with other ones is made."""

import dataclasses
from collections.abc import Mapping
from functools import cache
from typing import Any

from vfcore.constants import FoldConstants
from vfcore.errors import ParameterError
from vfcore.fields import check_number
from vfcore.params import PostureOverride, Simulation
from vfcore.request import FOLD_NAMES, numeric_paths
from vfcore.schema import parameter_schema


@cache
def numbers() -> dict[str, dict[str, Any]]:
    """The schema row (label, unit, min, max, type, …) of every path a sweep may vary."""
    rows = {row["key"]: row for row in parameter_schema()}
    return {path: rows[path] for path in numeric_paths()}


def check_path(path: Any, at: str) -> str:
    """``path`` when a sweep may vary it; ParameterError at the dotted place ``at`` otherwise."""
    if not isinstance(path, str) or path not in numbers():
        raise ParameterError(
            at, f"{path!r} is not a number of a request" if isinstance(path, str) else "is not the name of a number",
            "a dotted path such as activation.ct, subglottal_pressure_pa or constants.K_col_pa_m",
        )  # fmt: skip
    return path


def check_value(path: str, value: Any, at: str) -> float | int:
    """``value`` in the one form ``path`` is stored in; ParameterError at the dotted place ``at``."""
    row = numbers()[path]
    whole = row["type"] == "integer"
    check_number(at, value, row["min"], row["max"], row["unit"], integer=whole)
    return int(value) if whole else float(value) + 0.0  # -0.0 is 0.0


def document_with_numbers(document: dict[str, Any], values: Mapping[str, float], default: "Defaults") -> dict[str, Any]:
    """The canonical document of ``with_numbers`` from the canonical one of its base, a hundred times faster."""
    changed = dict(document)
    copied: set[str] = set()
    for path, value in values.items():
        part, _, name = path.rpartition(".")
        if not part:
            changed[name] = value
            continue
        if part not in copied:
            changed[part] = dict(_POSTURE if document[part] is None else document[part])
            copied.add(part)
        if part == "constants" and value == default.constant(name):
            changed[part].pop(name, None)
        else:
            changed[part][name] = value
    return changed


_POSTURE = dataclasses.asdict(PostureOverride())


class Defaults:
    """The constants a request has when none is overridden: of the paper, and of its set of posturing tables."""

    def __init__(self, base: Simulation):
        from vfcore.posture.tables import posture_set

        self._fold, self._set = FoldConstants(), posture_set(base.model.resolved().posture_set)

    def constant(self, name: str) -> float:
        return getattr(self._fold, name) if name in FOLD_NAMES else self._set.value(name)
