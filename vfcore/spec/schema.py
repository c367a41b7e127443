"""Every parameter a request may set, as rows for sliders, help texts, tables and docs.

The rows are read off the dataclasses that hold and validate the values, so a field added there appears everywhere.
"""

import dataclasses
import math
from collections.abc import Iterator, Mapping
from typing import Any

from vfcore.spec.area_functions import area_function
from vfcore.spec.fold_constants import FoldConstants
from vfcore.spec.posture_sets import POSTURE_SETS, constant_names, posture_set
from vfcore.spec.presets import PRESETS
from vfcore.spec.simulation import (
    GRID_LIMITS,
    PAPER_STEP_S,
    STEP_LIMITS_S,
    VARIANTS,
    VOWELS,
    Activation,
    Model,
    PostureOverride,
    Run,
    Simulation,
)

MUSCLES, BREATH, TRACT, MODEL, POSTURE, RUN = "muscles", "breath", "tract", "model", "posture", "run"
FOLD_CONSTANTS, POSTURING_CONSTANTS = "constants", "posturing constants"
GROUPS = (MUSCLES, BREATH, TRACT, MODEL, POSTURE, RUN, FOLD_CONSTANTS, POSTURING_CONSTANTS)

_TOP_GROUP = {"subglottal_pressure_pa": BREATH, "convergence_angle_rad": POSTURE, "vowel": TRACT}
_DEFAULT_SET = VARIANTS[Model().variant].posture_set
_KEYWORDS = {
    "i": "heed", "I": "hid", "e": "hayed", "E": "head", "AE": "had", "V": "hud", "a": "hod", "O": "hawed", "o": "hoed",
    "U": "hood", "u": "who'd",
}  # fmt: skip
_NUMERICS = "numerical choice of this implementation"
# The grid and the step are validated against named limits; their rows say the same.
_RUN_NUMBERS = {
    "nx": {
        "label": "nodes along the fold", "unit": "1", "low": GRID_LIMITS["nx"][0], "high": GRID_LIMITS["nx"][1],
        "step": 1, "integer": True, "symbol": "N_x", "source": _NUMERICS,
        "help": "anterior to posterior, ends included",
    },
    "ny": {
        "label": "nodes over the thickness", "unit": "1", "low": GRID_LIMITS["ny"][0], "high": GRID_LIMITS["ny"][1],
        "step": 1, "integer": True, "symbol": "N_y", "source": _NUMERICS,
        "help": "superior to inferior, edges included",
    },
    "time_step_s": {
        "label": "time step", "unit": "s", "low": STEP_LIMITS_S[0], "high": STEP_LIMITS_S[1], "symbol": "Δt",
        "source": _NUMERICS, "help": f"null: chosen for the grid and the posture; the paper's is {PAPER_STEP_S!r}",
    },
}  # fmt: skip


def parameter_schema() -> list[dict[str, Any]]:
    """One row per request parameter, in the order of display.

    Keys of a row: ``key`` (dotted path in the request), ``label``, ``symbol``, ``unit``, ``type`` (number | integer |
    choice | boolean), ``nullable``, ``default``, ``min``, ``max``, ``step``, ``group`` (one of GROUPS), ``help``,
    ``source``, ``options`` (of a choice, else None); and of posturing constants ``default_by_posture_set``.
    """
    rows = [
        *_rows(Activation, "activation.", MUSCLES),
        *_rows(Simulation, "", None),
        *_rows(Model, "model.", MODEL),
        *_rows(PostureOverride, "posture.", POSTURE),
        *_rows(Run, "run.", RUN),
        *_rows(FoldConstants, "constants.", FOLD_CONSTANTS),
        *_posturing_rows(),
    ]
    return sorted(rows, key=lambda row: GROUPS.index(row["group"]))


def parameter_catalogue() -> dict[str, Any]:
    """What a client needs to offer the parameters: rows, groups, presets, vowels and model variants."""
    return {
        "parameters": parameter_schema(),
        "groups": list(GROUPS),
        "presets": [preset._asdict() for preset in PRESETS],
        "vowels": [_vowel(key) for key in VOWELS],
        "variants": [{"key": key} | dataclasses.asdict(variant) for key, variant in VARIANTS.items()],
    }


def _rows(kind: type, prefix: str, group: str | None) -> Iterator[dict[str, Any]]:
    """Rows of the declared fields of a dataclass; ``group`` None: by name, for the top of the request."""
    for spec in dataclasses.fields(kind):
        metadata = spec.metadata or (_RUN_NUMBERS.get(spec.name) if kind is Run else None)
        if metadata:
            yield _row(prefix + spec.name, spec.default, metadata, group or _TOP_GROUP[spec.name])


def _posturing_rows() -> Iterator[dict[str, Any]]:
    sets = {name: posture_set(name) for name in POSTURE_SETS}
    for name, metadata in constant_names().items():
        defaults = {key: constants.value(name) for key, constants in sets.items()}
        row = _row(f"constants.{name}", defaults[_DEFAULT_SET], metadata, POSTURING_CONSTANTS)
        yield row | {"default_by_posture_set": defaults}


def _row(key: str, default, metadata: Mapping[str, Any], group: str) -> dict[str, Any]:
    options, is_flag = metadata.get("options"), "flag" in metadata
    is_number = options is None and not is_flag
    low, high = metadata.get("low"), metadata.get("high")
    return {
        "key": key,
        "label": metadata["label"],
        "symbol": metadata.get("symbol", ""),
        "unit": metadata["unit"] if is_number else None,
        "type": _type(metadata),
        "nullable": default is None,
        "default": default,
        "min": low,
        "max": high,
        "step": (metadata.get("step") or sensible_step(default, low, high)) if is_number else None,
        "group": group,
        "help": metadata.get("help", ""),
        "source": metadata["source"],
        "options": None if options is None else list(options),
    }


def _type(metadata: Mapping[str, Any]) -> str:
    if "flag" in metadata:
        return "boolean"
    if "options" in metadata:
        return "choice"
    return "integer" if metadata.get("integer") else "number"


def sensible_step(default: float | None, low: float, high: float) -> float:
    """A 1-2-5 number near 1 % of the default (of the range where there is none): the step of an undeclared slider."""
    size = abs(default) if default else high - low
    exponent = math.floor(math.log10(size / 100))
    mantissa = size / 100 / 10.0**exponent
    return float(f"{1 if mantissa < 1.5 else 2 if mantissa < 3.5 else 5 if mantissa < 7.5 else 10}e{exponent}")


def _vowel(key: str) -> dict[str, str]:
    ipa = area_function(key).ipa
    return {"key": key, "ipa": ipa, "label": f"/{ipa}/ as in {_KEYWORDS[key]}"}
