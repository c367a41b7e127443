"""A request document from what the command line says: preset, file, single options, --set; later beats earlier."""

import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from vfcore.errors import ParameterError
from vfcore.spec.presets import PRESETS


def request_document(
    preset: str | None, path: str | None, changes: Mapping[str, Any], settings: Sequence[str]
) -> dict[str, Any]:
    """The merged document, not yet validated.

    ``changes``: values by dotted path. ``settings``: texts PATH=VALUE. ParameterError for an unknown preset, a file
    that cannot be read, a text without a path.
    """
    document: dict[str, Any] = {}
    if preset is not None:
        document = _merged(document, _preset(preset))
    if path is not None:
        document = _merged(document, read_document("--request", path))
    for key, value in changes.items():
        _put(document, key, value)
    for setting in settings:
        key, separator, text = setting.partition("=")
        if not separator or not key:
            raise ParameterError("--set", f"{setting!r} sets nothing", "PATH=VALUE, such as run.start=static")
        _put(document, key, _value(text))
    return document


def _preset(name: str) -> dict[str, Any]:
    for preset in PRESETS:
        if preset.key == name:
            return preset.request
    raise ParameterError("--preset", f"{name!r} is not known", " | ".join(preset.key for preset in PRESETS))


def read_document(option: str, path: str) -> dict[str, Any]:
    """The JSON object in a file, or on standard input for ``-``; ParameterError of ``option``."""
    allowed = "a readable file with a request document in JSON, or - for standard input"
    try:
        text = sys.stdin.read() if path == "-" else Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "not UTF-8 text"
        raise ParameterError(option, f"{path}: {reason}", allowed) from error
    try:
        document = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise ParameterError(option, f"{path}: not JSON ({error})", allowed) from error
    if not isinstance(document, dict):
        raise ParameterError(option, f"{path}: a JSON {type(document).__name__}, not an object", allowed)
    return document


def _value(text: str) -> Any:
    """JSON where it is JSON, otherwise the text itself."""
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        return text


def _merged(base: Mapping[str, Any], over: Mapping[str, Any]) -> dict[str, Any]:
    merged = dict(base)
    for key, value in over.items():
        both = isinstance(value, Mapping) and isinstance(merged.get(key), Mapping)
        merged[key] = _merged(merged[key], value) if both else _copied(value)
    return merged


def _copied(value: Any) -> Any:
    return _merged({}, value) if isinstance(value, Mapping) else value


def _put(document: dict[str, Any], key: str, value: Any) -> None:
    *parents, last = key.split(".")
    at = document
    for name in parents:
        if at.get(name) is None:
            at[name] = {}
        at = at[name]
        if not isinstance(at, dict):
            raise ParameterError(key, f"{name} is {at!r}, which has no fields", "the path of a field of the request")
    at[last] = value
