"""What becomes of work, written down for every job that waits for it: on disk first, then told to its client."""

import logging
import threading
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from typing import Any

from vfcore.runs.result import SimulationResult
from vfcore.runs.sweep.row import Row, columns, failed_row
from vocalis.server.http.problems import problem_of
from vocalis.server.jobs.archive import Archive
from vocalis.server.jobs.database import StorageFull
from vocalis.server.jobs.document import job_document
from vocalis.server.jobs.events import DONE, POINT, PROGRESS, EventLog
from vocalis.server.jobs.model import Job, Status, WorkerDied
from vocalis.server.jobs.point_event import MOST_TOLD, point_document
from vocalis.server.jobs.points import PointStore
from vocalis.server.jobs.store import JobStore
from vocalis.server.jobs.sweep_work import SweepWork, Task

log = logging.getLogger("vocalis")


class Ledger:
    """The engine's listener. Thread-safe; ``lock`` is shared with the desk."""

    def __init__(self, store: JobStore, points: PointStore, archive: Archive, events: EventLog):
        self._store, self._points, self._archive, self._events = store, points, archive, events
        self.lock = threading.RLock()

    def say(self, job: Job, name: str = PROGRESS) -> None:
        """Tell a job's client how it stands."""
        self._events.publish(name, job.client, job.id, job_document(job, brief=True))

    def end(self, job: Job, status: Status) -> None:
        """Let a job be over, and keep that."""
        job.move(status)
        job.finished = job.finished or now()
        if status is Status.SUCCESSFUL:
            job.progress, job.n_done = 1.0, job.n_total
        try:
            self._store.save(job)
        finally:  # where the disk is full it is over nevertheless; a server that starts later finds it unfinished
            self.say(job, DONE)

    # Single runs.

    def started(self, work_id: str) -> None:
        with self.lock:
            for job in self._store.handles(work_id):
                job.move(Status.RUNNING)
                job.started = job.started or now()
                self._keep(job)

    def progressed(self, work_id: str, fraction: float) -> None:
        with self.lock:
            for job in self._store.handles(work_id):
                job.progress = fraction
                self.say(job)

    def retried(self, work_id: str) -> None:
        with self.lock:
            for job in self._store.handles(work_id):
                job.move(Status.ACCEPTED)
                job.progress = 0.0
                self._keep(job)

    def finished(self, work_id: str, result: SimulationResult | None) -> None:
        """``result`` None: it is stored already."""
        handles = self._handles(work_id)
        if result is not None and handles:
            try:
                self._archive.put(handles[0].content, result)
            except StorageFull as error:
                self.failed(work_id, problem_of(error))
                return
        self._end_all(work_id, Status.SUCCESSFUL)

    def failed(self, work_id: str, problem: dict[str, Any]) -> None:
        with self.lock:
            for job in self._store.handles(work_id):
                job.problem = problem
                job.n_failed = max(job.n_failed, 1)
        self._end_all(work_id, Status.FAILED)

    def died(self, work_id: str, exit_code: int | None) -> None:
        self.failed(work_id, problem_of(WorkerDied(f"The worker process ended twice, with exit code {exit_code}.")))

    # Sweeps.

    def linked(self, work: SweepWork, numbers: dict[int, int]) -> None:
        """Points of a sweep turned out to be stored."""
        with self.lock:
            jobs = self._count(work)
            self._points.link(work.id, numbers, jobs)
        self._tell_linked(work, jobs, list(numbers))

    def computed(self, task: Task, rows: list[Row]) -> None:
        """A task is done: its points are stored before anybody hears of them."""
        work = task.work
        failed = sum(row.state is None for row in rows)
        with self._counted(task, failed) as jobs:
            self._points.put(work.id, task.positions, task.addresses, rows, jobs)
        self._tell(work, task.positions, rows)

    def gave_up(self, task: Task, problem: str) -> None:
        """A task has no answer, and is not tried again."""
        work = task.work
        with self._counted(task, len(task.positions)) as jobs:
            self._points.give_up(work.id, task.positions, problem, jobs)
        width = len(columns(work.sweep))
        self._tell(work, task.positions, [failed_row(problem, width) for _ in task.positions])

    def keep_results(self, task: Task, results: dict[int, SimulationResult]) -> None:
        """Whole results of points, where a sweep keeps them: at the address of the same single run."""
        for place, result in results.items():
            self._archive.put(task.work.sweep.computation(task.positions[place]).address(), result)

    @contextmanager
    def _counted(self, task: Task, failed: int) -> Iterator[list[Job]]:
        """The jobs that wait for a task with its points counted in, to be stored in the block."""
        work, size = task.work, len(task.positions)
        with self.lock:
            work.account(size, failed)
            try:
                yield self._count(work)
            except BaseException:  # not stored: not done
                work.account(-size, -failed)
                self._count(work)
                raise

    def _count(self, work: SweepWork) -> list[Job]:
        jobs = self._store.handles(work.id)
        for job in jobs:
            job.n_done, job.n_failed = work.n_done, work.n_failed
            job.progress = work.n_done / job.n_total
        return jobs

    def _tell(self, work: SweepWork, positions: list[int], rows: list[Row]) -> None:
        with self.lock:
            for job in self._store.handles(work.id):
                self._events.publish(POINT, job.client, job.id, point_document(job.id, work.sweep, positions, rows))
                self.say(job)

    def _tell_linked(self, work: SweepWork, jobs: Iterable[Job], positions: list[int]) -> None:
        rows: list[Row] | None = None
        if jobs and len(work.sweep) <= MOST_TOLD:
            found = dict(self._points.rows(work.id, len(columns(work.sweep))))
            rows = [found[position] for position in positions]
        with self.lock:
            for job in jobs:
                told = point_document(job.id, work.sweep, positions, rows)
                self._events.publish(POINT, job.client, job.id, told)
                self.say(job)

    def _handles(self, work_id: str) -> list[Job]:
        with self.lock:
            return self._store.handles(work_id)

    def _end_all(self, work_id: str, status: Status) -> None:
        with self.lock:
            for job in self._store.handles(work_id):
                try:
                    self.end(job, status)
                except StorageFull as error:
                    log.warning("%s", error)

    def _keep(self, job: Job) -> None:
        with suppress(StorageFull):  # what follows will say so; a server that starts later begins again
            self._store.save(job)
        self.say(job)


def now() -> str:
    """ISO 8601 in UTC."""
    return datetime.now(UTC).isoformat(timespec="milliseconds")
