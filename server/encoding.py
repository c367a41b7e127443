"""Arrays as bytes: little-endian float32, C order, described by a JSON header."""

import json
import struct
from collections.abc import Iterable
from typing import Any

import numpy as np

from vfcore.errors import ParameterError
from vfcore.runs.result import ARRAYS, SimulationResult

ALIGN = 4


def float32_bytes(array: np.ndarray) -> bytes:
    """An array as little-endian float32 in C order."""
    return np.ascontiguousarray(array, dtype="<f4").tobytes()


def chosen_names(arrays: str | None) -> tuple[str, ...]:
    """Array names from ``a,b``; all of them for None. ParameterError for a name no result has."""
    if arrays is None:
        return tuple(ARRAYS)
    names = tuple(name.strip() for name in arrays.split(",") if name.strip())
    for name in names:
        if name not in ARRAYS:
            raise ParameterError("arrays", f"{name!r} is not an array of a result", ", ".join(ARRAYS))
    return names


def bundle(document: dict[str, Any], result: SimulationResult, names: Iterable[str]) -> bytes:
    """One reply with everything: uint32 header length, JSON header, array data.

    The header is ``document`` with ``arrays`` listing the chosen ones, each with its ``offset`` in bytes from the
    start of the data, which follows the header; both are multiples of 4 (the header is padded with spaces).
    """
    table, parts, offset = {}, [], 0
    for name in names:
        array, spec = result.arrays[name], ARRAYS[name]
        data = float32_bytes(array)
        table[name] = {
            "offset": offset,
            "shape": list(array.shape),
            "dtype": "float32",
            "unit": spec.unit,
            "dims": list(spec.dims),
        }
        parts.append(data)
        offset += len(data)
    header = json.dumps(document | {"arrays": table}, separators=(",", ":"), allow_nan=False).encode()
    header += b" " * (-len(header) % ALIGN)
    return b"".join([struct.pack("<I", len(header)), header, *parts])
