"""Records what happens to work for every job that waits for it: on disk first, then as events for the clients."""

import logging
import threading
from collections.abc import Callable
from contextlib import suppress
from datetime import UTC, datetime
from typing import Any

from vocalis.server.exceptions import StorageFull
from vocalis.server.jobs.document import job_document
from vocalis.server.jobs.events import DONE, POINT, PROGRESS, EventLog
from vocalis.server.jobs.model import Job, Status
from vocalis.server.jobs.store import JobStore
from vocalis.server.problems import problem_of

log = logging.getLogger("vocalis")


class JobRecorder:
    """The listener of all work. Thread-safe; ``lock`` is shared with the job service."""

    def __init__(self, jobs: JobStore, events: EventLog):
        self._jobs, self._events = jobs, events
        self.lock = threading.RLock()

    def publish(self, job: Job, name: str = PROGRESS) -> None:
        """Send the state of a job to its client."""
        self._events.publish(name, job.client, job.id, job_document(job, brief=True))

    def end(self, job: Job, status: Status) -> None:
        """End a job, and store that."""
        job.move(status)
        job.finished = job.finished or now()
        if status is Status.SUCCESSFUL:
            job.progress, job.n_done = 1.0, job.n_total
        try:
            self._jobs.save(job)
        finally:  # on a full disk the job has ended all the same; a server that starts later finds it unfinished
            self.publish(job, DONE)

    def started(self, work_id: str) -> None:
        """A worker has begun."""
        with self.lock:
            for job in self._jobs.handles(work_id):
                job.move(Status.RUNNING)
                job.started = job.started or now()
                self._save(job)

    def progressed(self, work_id: str, fraction: float) -> None:
        """``fraction`` of the work is done; kept in memory only."""
        with self.lock:
            for job in self._jobs.handles(work_id):
                job.progress = fraction
                self.publish(job)

    def retried(self, work_id: str) -> None:
        """The worker died, and the work begins again."""
        with self.lock:
            for job in self._jobs.handles(work_id):
                job.move(Status.ACCEPTED)
                job.progress = 0.0
                self._save(job)

    def count(self, work_id: str, n_done: int, n_failed: int) -> list[Job]:
        """The jobs that wait for work of many parts, with their new counts; the caller saves them with the parts.

        To be called, and the jobs saved, with ``lock`` held.
        """
        jobs = self._jobs.handles(work_id)
        for job in jobs:
            job.n_done, job.n_failed = n_done, n_failed
            job.progress = n_done / job.n_total
        return jobs

    def publish_part(self, work_id: str, document: Callable[[str], dict[str, Any]]) -> None:
        """Send each client a part of the answer, ``document`` of its job's id, as a ``point`` event; then the state."""
        with self.lock:
            for job in self._jobs.handles(work_id):
                self._events.publish(POINT, job.client, job.id, document(job.id))
                self.publish(job)

    def finished(self, work_id: str, store: Callable[[], None] | None = None) -> None:
        """The answer is there. ``store`` keeps it, and is called only if a job still waits for it."""
        with self.lock:
            has_handles = bool(self._jobs.handles(work_id))
        if store is not None and has_handles:
            try:
                store()
            except StorageFull as error:
                self.failed(work_id, problem_of(error))
                return
        self._end_all(work_id, Status.SUCCESSFUL)

    def failed(self, work_id: str, problem: dict[str, Any]) -> None:
        """The work has ended with a problem."""
        with self.lock:
            for job in self._jobs.handles(work_id):
                job.problem = problem
                job.n_failed = max(job.n_failed, 1)
        self._end_all(work_id, Status.FAILED)

    def _end_all(self, work_id: str, status: Status) -> None:
        with self.lock:
            for job in self._jobs.handles(work_id):
                try:
                    self.end(job, status)
                except StorageFull as error:
                    log.warning("%s", error)

    def _save(self, job: Job) -> None:
        with suppress(StorageFull):  # the end of the job will report it; a server that starts later begins again
            self._jobs.save(job)
        self.publish(job)


def now() -> str:
    """ISO 8601 in UTC."""
    return datetime.now(UTC).isoformat(timespec="milliseconds")
