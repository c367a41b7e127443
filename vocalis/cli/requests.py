"""The request patch of a command line: preset, file, single options, --set; later overrides earlier."""

import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from vfcore.errors import ParameterError
from vfcore.spec.presets import PRESETS
from vfcore.spec.request import flat, merged


def request_patch(
    preset: str | None, path: str | None, changes: Mapping[str, Any], settings: Sequence[str]
) -> dict[str, Any]:
    """All sources as one patch, not yet resolved.

    ``changes``: values by dotted path. ``settings``: texts PATH=VALUE. ParameterError for an unknown preset, a file
    that cannot be read, a text without a path, a field that no request has.
    """
    patch: dict[str, Any] = {}
    if preset is not None:
        patch |= flat(_preset(preset))
    if path is not None:
        patch = merged(patch, flat(read_document("--request", path)))
    patch = merged(patch, changes)
    for setting in settings:
        key, separator, text = setting.partition("=")
        if not separator or not key:
            raise ParameterError("--set", f"{setting!r} sets nothing", "PATH=VALUE, such as run.start=static")
        patch = merged(patch, flat({key: _value(text)}))
    return patch


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
    """The text parsed as JSON, or the text itself if it is not JSON."""
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        return text
