"""Where a piece of work is computed, and how that may end: a worker process, or a place on a cluster."""

import threading
from collections.abc import Callable
from typing import Any, NamedTuple, Protocol


class Finished(NamedTuple):
    result: Any


class Failed(NamedTuple):
    problem: dict[str, Any]


class Stopped(NamedTuple):
    pass


class Died(NamedTuple):
    exit_code: int | None


Outcome = Finished | Failed | Stopped | Died


class NoConnection(Exception):
    """The cluster cannot be reached just now."""


class Lane(Protocol):
    """Used by one thread at a time, except ``close``."""

    def run(self, kind: str, piece: Any, progress: Callable[[float], None], stop: threading.Event) -> Outcome:
        """Have work done; returns when it is finished, failed, stopped, or the process died. NoConnection."""

    def close(self) -> None:
        """End what is computing now."""


class Cluster(Protocol):
    """Lanes on other machines: at most ``most``, ``capacity`` at present."""

    most: int
    lanes: int

    @property
    def capacity(self) -> int: ...
    def start(self) -> None: ...
    def new_lane(self) -> Lane: ...
    def close(self) -> None: ...
