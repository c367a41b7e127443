"""A finished run as one file that can be read back to the same ``SimulationResult``, bit for bit.

A zip of numpy arrays (``.npz``), one of which holds the rest as JSON; zip checksums show a damaged file.
"""

import dataclasses
import itertools
import json
import os
import types
import typing
import zipfile
from typing import Any

import numpy as np

from vfcore.errors import VocalisError
from vfcore.io.atomic import replacing
from vfcore.runs.result import SimulationResult
from vfcore.spec.request import document_of, resolve
from vfcore.spec.simulation import Simulation

_HEAD = "head"


class DamagedFile(VocalisError):
    """A stored result that cannot be read back: damaged, or written by a version with other fields."""


def save_result(result: SimulationResult, path: str | os.PathLike) -> int:
    """Write the file whole and on the disk, or not at all; returns its size in bytes. OSError as for ``replacing``."""
    arrays: dict[str, Any] = {}
    arrays[_HEAD] = np.frombuffer(json.dumps(_plain(result, "", arrays)).encode(), np.uint8)
    with replacing(path) as draft:
        with open(draft, "wb") as file:
            np.savez(file, **arrays)
            file.flush()
            os.fsync(file.fileno())
        return draft.stat().st_size


def load_result(path: str | os.PathLike) -> SimulationResult:
    """The result that was saved; DamagedFile, or FileNotFoundError."""
    try:
        with np.load(path, allow_pickle=False) as file:
            arrays = {name: file[name] for name in file.files}
        return _built(SimulationResult, json.loads(arrays.pop(_HEAD).tobytes()), arrays)
    except FileNotFoundError:
        raise
    except (VocalisError, OSError, ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile) as error:
        raise DamagedFile(f"{path} cannot be read back: {error}") from error


def _plain(value: Any, path: str, arrays: dict[str, np.ndarray]) -> Any:
    if isinstance(value, Simulation):
        return document_of(value)
    if isinstance(value, np.ndarray):
        arrays[path] = value
        return path
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, dict):
        return {key: _plain(item, f"{path}/{key}", arrays) for key, item in value.items()}
    if type(value) is tuple:
        return [_plain(item, f"{path}/{k}", arrays) for k, item in enumerate(value)]
    if names := _names(type(value)):
        return {name: _plain(getattr(value, name), f"{path}/{name}", arrays) for name in names}
    return value


def _built(kind: Any, plain: Any, arrays: dict[str, np.ndarray]) -> Any:
    """The value of type ``kind`` that ``_plain`` was given."""
    if kind is Simulation:
        return resolve(plain)
    if kind is np.ndarray:
        return arrays[plain]
    if names := _names(kind):
        hints = typing.get_type_hints(kind)
        return kind(**{name: _built(hints[name], plain[name], arrays) for name in names})
    origin, inner = typing.get_origin(kind), typing.get_args(kind)
    if origin is dict:
        return {key: _built(inner[1], item, arrays) for key, item in plain.items()}
    if origin in (types.UnionType, typing.Union):
        return None if plain is None else _built(next(arg for arg in inner if arg is not type(None)), plain, arrays)
    if origin is tuple:
        kinds = itertools.repeat(inner[0]) if inner[-1] is Ellipsis else inner
        return tuple(_built(one, item, arrays) for one, item in zip(kinds, plain, strict=False))
    return plain


def _names(kind: Any) -> tuple[str, ...]:
    """Field names of a dataclass or a NamedTuple; empty for anything else."""
    if dataclasses.is_dataclass(kind):
        return tuple(field.name for field in dataclasses.fields(kind))
    return getattr(kind, "_fields", ())
