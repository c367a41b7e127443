"""Work as the scheduler sees it: an identity, tasks to compute, and an end. A kind of job makes its own.

``SingleWork`` is one computation in one piece. Work of many tasks, such as a sweep, is a class of its kind.
"""

import threading
from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Any, Protocol

from vocalis.server.exceptions import WorkerDied
from vocalis.server.jobs.executor_slot import Call, Died, ExecutorSlot, Failed, Finished
from vocalis.server.jobs.model import Job
from vocalis.server.problems import problem_of

ATTEMPTS = 2  # a worker may die once during a piece of work


class WorkListener(Protocol):
    """Records what happens to work for every job that waits for it; called from the scheduler's threads."""

    lock: threading.RLock

    def started(self, work_id: str) -> None: ...
    def progressed(self, work_id: str, fraction: float) -> None: ...
    def retried(self, work_id: str) -> None: ...
    def count(self, work_id: str, n_done: int, n_failed: int) -> list[Job]: ...
    def publish_part(self, work_id: str, document: Callable[[str], dict[str, Any]]) -> None: ...
    def finished(self, work_id: str, store: Callable[[], None] | None = None) -> None: ...
    def failed(self, work_id: str, problem: dict[str, Any]) -> None: ...


class Task(Protocol):
    """What one executor slot computes in one go."""

    def run(self, slot: ExecutorSlot) -> dict[str, Any] | None:
        """Compute and record it. Returns the problem that ends the whole work, None when there is none."""

    def close(self) -> None:
        """Release what the task holds, however it ended."""


class Work(ABC):
    """One computation, however many jobs wait for it. The attributes from ``begun`` on belong to the scheduler.

    ``is_shared``: its tasks take turns with those of other shared work, and may run on a cluster. Work that is not
    shared goes first, in the order of its submission.
    """

    is_shared = False

    def __init__(self, work_id: str, listener: WorkListener):
        self.id, self.listener = work_id, listener
        self.stop = threading.Event()
        self.begun = False
        self.tasks_out = 0
        self.asked_at = -1
        self.workers = 1  # how many there are for its tasks

    @property
    def most_tasks(self) -> int:
        """How many tasks can be under way at the same time."""
        return 1

    @abstractmethod
    def next_task(self) -> Task | None:
        """The next task; None while everything that is left is under way."""

    @property
    @abstractmethod
    def is_complete(self) -> bool:
        """Whether all tasks are done."""

    @abstractmethod
    def finish(self) -> None:
        """Store the answer of complete work, and report that it is finished."""


class SingleWork(Work):
    """One call, tried again once when its worker dies. ``store`` keeps its result."""

    def __init__(self, work_id: str, listener: WorkListener, call: Call, store: Callable[[Any], None]):
        super().__init__(work_id, listener)
        self.call = call
        self._store = store
        self._outcome: Finished | None = None

    def next_task(self) -> "SingleWork":
        return self

    @property
    def is_complete(self) -> bool:
        return self._outcome is not None

    def run(self, slot: ExecutorSlot) -> dict[str, Any] | None:
        for attempt in range(1, ATTEMPTS + 1):
            self.listener.started(self.id)
            outcome = slot.run(self.call, lambda fraction: self.listener.progressed(self.id, fraction), self.stop)
            if isinstance(outcome, Finished):
                self._outcome = outcome
            elif isinstance(outcome, Failed):
                return outcome.problem
            elif isinstance(outcome, Died) and not self.stop.is_set():
                if attempt < ATTEMPTS:
                    self.listener.retried(self.id)
                    continue
                return problem_of(WorkerDied(f"The worker process ended twice, with exit code {outcome.exit_code}."))
            break
        return None

    def close(self) -> None:
        pass

    def finish(self) -> None:
        if self._outcome is not None:
            result = self._outcome.result
            self.listener.finished(self.id, lambda: self._store(result))
