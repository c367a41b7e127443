"""A piece of work that is no sweep, and who is told what becomes of work."""

import threading
from dataclasses import dataclass, field
from typing import Any, Protocol

from vocalis.server.jobs.sweep_task import SweepListener


@dataclass(slots=True)
class Work:
    """One computation, however many jobs wait for it."""

    id: str
    kind: str
    request: dict[str, Any]
    attempts: int = 0
    stop: threading.Event = field(default_factory=threading.Event)


class Listener(SweepListener, Protocol):
    """Who is told what becomes of work; called from the engine's threads."""

    def started(self, work_id: str) -> None: ...
    def progressed(self, work_id: str, fraction: float) -> None: ...
    def retried(self, work_id: str) -> None: ...
    def finished(self, work_id: str, result: Any) -> None: ...
    def failed(self, work_id: str, problem: dict[str, Any]) -> None: ...
    def died(self, work_id: str, exit_code: int | None) -> None: ...
