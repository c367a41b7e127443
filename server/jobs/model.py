"""A job, its states, and the one table of how it may move between them.

accepted ──> running ──> successful
    │  <──────┘  │            │
    │            ├──> failed  │        running → accepted: its worker died, it is tried again once
    └────────────┴──────┴─────┴──> dismissed
"""

from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

from vfcore.errors import VocalisError


class IllegalTransition(VocalisError):
    """The transition table has no such arrow."""


class Status(StrEnum):
    ACCEPTED = "accepted"
    RUNNING = "running"
    SUCCESSFUL = "successful"
    FAILED = "failed"
    DISMISSED = "dismissed"


TRANSITIONS: dict[Status, frozenset[Status]] = {
    Status.ACCEPTED: frozenset({Status.RUNNING, Status.SUCCESSFUL, Status.FAILED, Status.DISMISSED}),
    Status.RUNNING: frozenset({Status.ACCEPTED, Status.SUCCESSFUL, Status.FAILED, Status.DISMISSED}),
    Status.SUCCESSFUL: frozenset({Status.DISMISSED}),
    Status.FAILED: frozenset({Status.DISMISSED}),
    Status.DISMISSED: frozenset(),
}
ACTIVE = (Status.ACCEPTED, Status.RUNNING)


@dataclass(slots=True)
class Job:
    """One client's handle on work. ``work_id`` is shared by all handles on one computation; ``content``
    addresses its result. Times are ISO 8601 in UTC.
    """

    id: str
    client: str
    kind: str
    request: dict[str, Any]
    content: str
    work_id: str
    created: str
    sequence: int = 0
    status: Status = Status.ACCEPTED
    progress: float = 0.0
    n_done: int = 0
    n_total: int = 1
    n_failed: int = 0
    fresh: bool = False
    started: str | None = None
    finished: str | None = None
    problem: dict[str, Any] | None = field(default=None)

    def move(self, status: Status) -> None:
        """Change state; IllegalTransition when the table has no such arrow."""
        if status not in TRANSITIONS[self.status]:
            raise IllegalTransition(f"a job that is {self.status} cannot become {status}")
        self.status = status
