"""Output files of a command: checked before the work, written after it."""

import os
import tempfile
from collections.abc import Callable
from pathlib import Path

from vfcore.errors import ParameterError

_ALLOWED = "a file in an existing folder that can be written"


def check_writable(option: str, path: str | None) -> None:
    """ParameterError if ``path`` cannot be written, before a long run and not after it."""
    if path is None:
        return
    target = Path(path)
    if target.is_dir():
        raise ParameterError(option, f"{path} is a folder", _ALLOWED)
    try:
        with tempfile.TemporaryFile(dir=target.parent):
            pass
    except OSError as error:
        raise _refusal(option, path, error) from error


def save(option: str, path: str | None, write: Callable[[Path], object]) -> None:
    """Call ``write(path)`` unless ``path`` is None; ParameterError if it fails."""
    if path is None:
        return
    try:
        write(Path(path))
    except OSError as error:
        raise _refusal(option, path, error) from error


def _refusal(option: str, path: str | os.PathLike, error: OSError) -> ParameterError:
    return ParameterError(option, f"{path}: {(error.strerror or str(error)).lower()}", _ALLOWED)
