"""Where a call is computed, and how that may end: a worker process, or a place on a cluster."""

import threading
from collections.abc import Callable
from typing import Any, NamedTuple, Protocol

Progress = Callable[[float], None]
Stop = Callable[[], bool]


class Call(NamedTuple):
    """A computation that another process can do: ``function(*arguments, progress=…, stop=…)``, both optional.

    The function is sent by its name, so the other process must be able to import it. ``addresses`` name what is
    computed, where the place of computation needs a name for it.
    """

    function: Callable[..., Any]
    arguments: tuple[Any, ...] = ()
    addresses: tuple[str, ...] = ()


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
    """The cluster cannot be reached at the moment."""


class ExecutorSlot(Protocol):
    """Used by one thread at a time, except ``close``."""

    def run(self, call: Call, progress: Progress, stop: threading.Event) -> Outcome:
        """Compute a call; returns when it is finished, failed, stopped, or the process died. NoConnection."""

    def close(self) -> None:
        """End the computation under way."""


class Cluster(Protocol):
    """Slots on other machines: at most ``most``, ``capacity`` at present."""

    most: int
    slots: int

    @property
    def capacity(self) -> int: ...
    def start(self) -> None: ...
    def new_slot(self) -> ExecutorSlot: ...
    def close(self) -> None: ...
