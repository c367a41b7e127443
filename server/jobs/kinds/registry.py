"""The kinds of jobs by name. All modules of this package are loaded on the first import of this one."""

import pkgutil
from importlib import import_module
from typing import Any

from vocalis.server.jobs import kinds
from vocalis.server.jobs.archive import ResultFormat
from vocalis.server.jobs.kinds.base import JobKind, UnknownKind

KINDS: dict[str, JobKind] = {}


def register(kind: JobKind) -> None:
    """Add a kind; the wire schemas take it up when they are imported."""
    KINDS[kind.name] = kind


def kind_named(name: str) -> JobKind:
    """The kind of a name; for a job of another version's kind one that refuses everything."""
    return KINDS.get(name) or UnknownKind(name)


def kind_of(request: dict[str, Any]) -> JobKind:
    """The kind of a canonical request document."""
    return kind_named(request["kind"])


def address_of(request: dict[str, Any]) -> str:
    """The content address of a canonical request document of any kind."""
    kind = kind_of(request)
    return kind.address(kind.parse(request))


def result_formats() -> list[ResultFormat]:
    """The formats of the results of all kinds, each once."""
    formats = {kind.format.ending: kind.format for kind in KINDS.values() if kind.format is not None}
    return list(formats.values())


for _module in pkgutil.iter_modules(kinds.__path__):
    import_module(f"{kinds.__name__}.{_module.name}")
