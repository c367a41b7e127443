"""Every parameter of a request, as rows for sliders, help texts, tables and docs.

The rows are read from the dataclasses that hold and validate the values, so a field added there appears everywhere.
"""

import dataclasses
import math
from typing import Any

from vfcore.spec.area_functions import area_function
from vfcore.spec.declarations import LARYNX, SIDES, Declaration, ListDeclaration
from vfcore.spec.larynx import CONSTANTS
from vfcore.spec.lesions import KINDS
from vfcore.spec.paths import DECLARATIONS, LISTS, PARTS
from vfcore.spec.posture_sets import POSTURE_SETS, posture_set
from vfcore.spec.presets import PRESETS
from vfcore.spec.simulation import VOWELS
from vfcore.spec.variants import VARIANTS

MUSCLES, BREATH, TRACT, MODEL, POSTURE, RUN = "muscles", "breath", "tract", "model", "posture", "run"
FOLD_CONSTANTS, POSTURING_CONSTANTS = "constants", "posturing constants"

_GROUP_OF_PART = {"activation": MUSCLES, "model": MODEL, "posture": POSTURE, "run": RUN}
#: In the order of display. A part not named here is a group with its own name.
GROUPS = (
    *(MUSCLES, BREATH, TRACT, MODEL, POSTURE, RUN),
    *(part for part in PARTS if "." not in part and part not in _GROUP_OF_PART),
    *(FOLD_CONSTANTS, POSTURING_CONSTANTS),
)
#: Of values at the top; one not named here belongs to the posture.
_GROUP_OF_PATH = {"subglottal_pressure_pa": BREATH, "vowel": TRACT}
_KEYWORDS = {
    "i": "heed", "I": "hid", "e": "hayed", "E": "head", "AE": "had", "V": "hud", "a": "hod", "O": "hawed", "o": "hoed",
    "U": "hood", "u": "who'd",
}  # fmt: skip


def parameter_schema() -> list[dict[str, Any]]:
    """One row per request parameter, in the order of display.

    Keys of a row: ``key`` (dotted path in the request), ``label``, ``symbol``, ``unit``, ``type`` (number | integer |
    choice | boolean), ``nullable``, ``default`` (of the paper's modal case), ``min``, ``max``, ``step``, ``group`` (one
    of GROUPS), ``help``, ``source``, ``options`` (of a choice, else None), ``optional_part`` (the part that may be
    null, else None), ``per_side`` (whether ``left.`` and ``right.`` before the key make a path of one fold); and of
    posturing constants ``default_by_posture_set``.
    """
    rows = [_row(declaration) for declaration in DECLARATIONS.values()]
    return sorted(rows, key=lambda row: GROUPS.index(row["group"]))


def parameter_catalogue() -> dict[str, Any]:
    """What a client needs to display the parameters: rows, groups, presets, vowels, model variants, and the lists.

    A list has ``key``, ``label``, ``help``, ``at_most`` and ``parameters``, the rows of an object's values, whose keys
    are names: the value ``height_mm`` of the first object has the path ``lesions.0.height_mm``.
    """
    return {
        "parameters": parameter_schema(),
        "groups": list(GROUPS),
        "presets": [preset._asdict() for preset in PRESETS],
        "vowels": [_vowel(key) for key in VOWELS],
        "sides": list(SIDES),
        "lists": [_list(row) for row in LISTS.values()],
        "lesion_kinds": [{"key": key} | dataclasses.asdict(kind) for key, kind in KINDS.items()],
        "variants": [{"key": key} | dataclasses.asdict(variant) for key, variant in VARIANTS.items()],
    }


def _list(of: ListDeclaration) -> dict[str, Any]:
    rows = [_described(row) | {"group": of.path} for row in of.rows.values()]
    return {"key": of.path, "label": of.label, "help": of.help, "at_most": of.at_most, "parameters": rows}


def _row(declaration: Declaration) -> dict[str, Any]:
    row = _described(declaration) | {"group": _group(declaration)}
    if row["group"] == POSTURING_CONSTANTS:
        row["default_by_posture_set"] = {name: posture_set(name).value(declaration.name) for name in POSTURE_SETS}
    return row


def _described(declaration: Declaration) -> dict[str, Any]:
    metadata, default = declaration.metadata, declaration.default
    options = metadata.get("options")
    low: Any = metadata.get("low")
    high: Any = metadata.get("high")
    return {
        "key": declaration.path,
        "label": metadata["label"],
        "symbol": metadata.get("symbol", ""),
        "unit": metadata.get("unit"),
        "type": metadata["type"],
        "nullable": default is None,
        "default": default,
        "min": low,
        "max": high,
        "step": (metadata["step"] or sensible_step(default, low, high)) if declaration.is_number else None,
        "help": metadata.get("help", ""),
        "source": metadata["source"],
        "options": None if options is None else list(options),
        "optional_part": declaration.optional[0] if declaration.optional else None,
        "per_side": declaration.per_side,
    }


def _outer(part: str) -> str:
    return part.partition(".")[0]


def _group(declaration: Declaration) -> str:
    if declaration.part == LARYNX:
        return POSTURING_CONSTANTS if CONSTANTS[declaration.name].table == "posturing" else FOLD_CONSTANTS
    if not declaration.part:
        return _GROUP_OF_PATH.get(declaration.path, POSTURE)
    outer = _outer(declaration.part)
    return _GROUP_OF_PART.get(outer, outer)


def sensible_step(default: float | None, low: float, high: float) -> float:
    """A 1-2-5 number near 1 % of the default, or of the range without a default: the step if none is declared."""
    size = abs(default) if default else high - low
    exponent = math.floor(math.log10(size / 100))
    mantissa = size / 100 / 10.0**exponent
    return float(f"{1 if mantissa < 1.5 else 2 if mantissa < 3.5 else 5 if mantissa < 7.5 else 10}e{exponent}")


def _vowel(key: str) -> dict[str, str]:
    ipa = area_function(key).ipa
    return {"key": key, "ipa": ipa, "label": f"/{ipa}/ as in {_KEYWORDS[key]}"}
