"""Numbers of a request by their dotted path: what they may be, and how a request with other ones is made."""

import dataclasses
from collections.abc import Mapping
from functools import cache
from typing import Any

from vfcore.errors import ParameterError
from vfcore.spec.document import numeric_paths
from vfcore.spec.fields import check_number
from vfcore.spec.schema import parameter_schema
from vfcore.spec.simulation import PostureOverride


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


def computation_with_numbers(computation: dict[str, Any], values: Mapping[str, float]) -> dict[str, Any]:
    """The computation of ``with_numbers`` from the computation of its base, a hundred times faster."""
    changed = dict(computation)
    copied: set[str] = set()
    for path, value in values.items():
        part, _, name = path.rpartition(".")
        if not part:
            changed[name] = value
            continue
        if part not in copied:
            changed[part] = dict(_POSTURE if computation[part] is None else computation[part])
            copied.add(part)
        changed[part][name] = value
    return changed


_POSTURE = dataclasses.asdict(PostureOverride())
