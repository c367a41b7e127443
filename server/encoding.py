"""Arrays as bytes: little-endian float32, C order, described by a JSON header."""

import json
import struct
from collections.abc import Iterable
from typing import Any

import numpy as np

from vfcore.errors import ParameterError
from vfcore.runs.result import ARRAYS, OF_TWO_WALLS, SimulationResult, dims_of

ALIGN = 4


def float32_bytes(array: np.ndarray) -> bytes:
    """An array as little-endian float32 in C order."""
    return np.ascontiguousarray(array, dtype="<f4").tobytes()


def chosen_names(arrays: str | None) -> tuple[str, ...] | None:
    """Array names from ``a,b``; None for None, which means all. ParameterError for a name no result has."""
    if arrays is None:
        return None
    names = tuple(name.strip() for name in arrays.split(",") if name.strip())
    for name in names:
        if name not in ARRAYS:
            raise ParameterError("arrays", f"{name!r} is not an array of a result", ", ".join(ARRAYS))
    return names


def array_of(result: SimulationResult, name: str, path: str) -> np.ndarray:
    """An array of a result; ParameterError at ``path`` for one that only two different folds have."""
    if name not in result.arrays:
        raise ParameterError(
            path, f"{name} needs two different folds, and here one is the mirror image of the other",
            ", ".join(other for other in ARRAYS if other not in OF_TWO_WALLS),
        )  # fmt: skip
    return result.arrays[name]


def bundle(document: dict[str, Any], result: SimulationResult, names: Iterable[str] | None) -> bytes:
    """One reply with everything: uint32 header length, JSON header, array data.

    ``names`` chooses the arrays, None is all that the result has; ParameterError as of ``array_of``. The header is
    ``document`` with ``arrays`` listing the chosen ones, each with its ``offset`` in bytes from the start of the data,
    which follows the header; both are multiples of 4 (the header is padded with spaces).
    """
    table, parts, offset = {}, [], 0
    for name in result.arrays if names is None else names:
        array = array_of(result, name, "arrays")
        data = float32_bytes(array)
        table[name] = {
            "offset": offset,
            "shape": list(array.shape),
            "dtype": "float32",
            "unit": ARRAYS[name].unit,
            "dims": list(dims_of(name, array)),
        }
        parts.append(data)
        offset += len(data)
    header = json.dumps(document | {"arrays": table}, separators=(",", ":"), allow_nan=False).encode()
    header += b" " * (-len(header) % ALIGN)
    return b"".join([struct.pack("<I", len(header)), header, *parts])
