"""Where jobs are handed in, asked about and dismissed: ties store, engine, results and events together.

A job is one client's handle on shared, content-addressed work. Work stops only when no handle is left.
"""

import threading
from datetime import UTC, datetime
from typing import Any
from uuid import uuid4

from vfcore.errors import ParameterError
from vfcore.result import SimulationResult
from vocalis_server.jobs.content import canonical, content_hash
from vocalis_server.jobs.document import job_document
from vocalis_server.jobs.engine import Engine, Work
from vocalis_server.jobs.events import DONE, PROGRESS, Event, EventLog
from vocalis_server.jobs.model import (
    ACTIVE,
    Job,
    NoSuchJob,
    NotFinished,
    QueueFull,
    ResultGone,
    Status,
    WorkerDied,
)
from vocalis_server.jobs.results import ResultCache
from vocalis_server.jobs.store import JobStore, KeyUse
from vocalis_server.problems import problem_of


class Desk:
    """Thread-safe. ``per_client`` and ``queue_length`` bound the unfinished jobs."""

    def __init__(
        self,
        results: ResultCache,
        events: EventLog,
        store: JobStore,
        workers: int,
        per_client: int,
        queue_length: int,
    ):
        self._results, self._events, self._store = results, events, store
        self._per_client, self._queue_length = per_client, queue_length
        self._lock = threading.RLock()
        self.engine = Engine(workers, self)

    def submit(self, client: str, request: dict[str, Any], fresh: bool = False, key: str | None = None) -> Job:
        """A job for a canonical request: the one this client already has, or a new one.

        Raises QueueFull at a limit, ParameterError when the Idempotency-Key was used for another request.
        """
        content = content_hash(request)
        with self._lock:
            if key is not None and (known := self._recall(client, key, content)) is not None:
                return known
            result = None if fresh else self._results.get(content)
            job = None if fresh else self._same(client, content, result is not None)
            if job is None:
                job = self._new(client, request, content, result, fresh)
            if key is not None:
                self._store.remember(client, key, KeyUse(content, job.id))
            return job

    def job(self, job_id: str) -> Job:
        """A job by its id, or a finished one standing for a synchronous run; NoSuchJob."""
        with self._lock:
            if (job := self._store.get(job_id)) is not None:
                return job
        if (result := self._results.get(job_id)) is not None:
            made = result.provenance.created
            return Job(
                job_id, "", "simulation", canonical(result.request), job_id, job_id, made,
                status=Status.SUCCESSFUL, progress=1.0, n_done=1, started=made, finished=made,
            )  # fmt: skip
        raise NoSuchJob(f"There is no job or kept result with the id {job_id!r}.")

    def jobs(
        self, client: str, status: Status | None, kind: str | None, limit: int, before: int | None
    ) -> tuple[list[Job], bool]:
        """Jobs of a client, newest first, and whether there are more."""
        with self._lock:
            return self._store.page(client, status, kind, limit, before)

    def result(self, job_id: str) -> SimulationResult:
        """The result of a finished job; NoSuchJob, NotFinished or ResultGone."""
        job = self.job(job_id)
        if job.status is not Status.SUCCESSFUL:
            why = f": {job.problem['detail']}" if job.problem else "."
            raise NotFinished(f"The job is {job.status}{why}")
        if (result := self._results.get(job.content)) is None:
            raise ResultGone("The result made room for newer ones; the same request makes it again.")
        return result

    def dismiss(self, job_id: str) -> Job:
        """Let go of a job; its work stops when nobody else waits for it. Doing it again changes nothing."""
        with self._lock:
            job = self._store.get(job_id)
            if job is None:
                raise NoSuchJob(f"There is no job with the id {job_id!r}.")
            if job.status is not Status.DISMISSED:
                was_active = job.status in ACTIVE
                self._end(job, Status.DISMISSED)
                if was_active and not self._store.handles(job.work_id):
                    self.engine.stop(job.work_id)
            return job

    def present(self, client: str, job_id: str | None) -> list[Event]:
        """The present state of a job, or of a client's unfinished jobs, as events outside the log."""
        with self._lock:
            if job_id is not None:
                jobs = [self.job(job_id)]
            else:
                newest, _ = self._store.page(client, None, None, self._per_client * 2, None)
                jobs = [job for job in newest if job.status in ACTIVE]
            return [
                Event("", PROGRESS if job.status in ACTIVE else DONE, client, job.id, job_document(job)) for job in jobs
            ]

    # What the engine says, from its threads.

    def started(self, work_id: str) -> None:
        with self._lock:
            for job in self._store.handles(work_id):
                job.move(Status.RUNNING)
                job.started = job.started or _now()
                self._say(job)

    def progressed(self, work_id: str, fraction: float) -> None:
        with self._lock:
            for job in self._store.handles(work_id):
                job.progress = fraction
                self._say(job)

    def retried(self, work_id: str) -> None:
        with self._lock:
            for job in self._store.handles(work_id):
                job.move(Status.ACCEPTED)
                job.progress = 0.0
                self._say(job)

    def finished(self, work_id: str, result: SimulationResult) -> None:
        with self._lock:
            for job in self._store.handles(work_id):
                self._results.put(job.content, result)
                self._end(job, Status.SUCCESSFUL)

    def failed(self, work_id: str, problem: dict[str, Any]) -> None:
        with self._lock:
            for job in self._store.handles(work_id):
                job.problem, job.n_failed = problem, 1
                self._end(job, Status.FAILED)

    def died(self, work_id: str, exit_code: int | None) -> None:
        self.failed(work_id, problem_of(WorkerDied(f"The worker process ended twice, with exit code {exit_code}.")))

    def _recall(self, client: str, key: str, content: str) -> Job | None:
        use = self._store.recall(client, key)
        if use is None:
            return None
        if use.content != content:
            raise ParameterError("Idempotency-Key", "was used for another request", "a new key, or the same request")
        return self._store.get(use.job_id)

    def _same(self, client: str, content: str, has_result: bool) -> Job | None:
        wanted = (*ACTIVE, Status.SUCCESSFUL) if has_result else ACTIVE
        return self._store.latest(content, wanted, client)

    def _new(
        self, client: str, request: dict[str, Any], content: str, result: SimulationResult | None, fresh: bool
    ) -> Job:
        shared = None if fresh or result is not None else self._store.latest(content, ACTIVE)
        work_id = shared.work_id if shared else uuid4().hex
        job = Job(uuid4().hex, client, request["kind"], request, content, work_id, _now())
        if shared:
            job.status, job.progress, job.started = shared.status, shared.progress, shared.started
        if result is None:
            self._check_limits(client)
        self._store.add(job)
        if result is not None:
            job.started = job.created
            self._end(job, Status.SUCCESSFUL)
            return job
        self._say(job)
        if not shared:
            self.engine.submit(Work(work_id, job.kind, request))
        return job

    def _check_limits(self, client: str) -> None:
        for count, limit, name in (
            (self._store.count_active(client), self._per_client, "unfinished jobs of one client"),
            (self.engine.waiting, self._queue_length, "jobs in the queue"),
        ):
            if count >= limit:
                raise QueueFull(f"There are {count} {name}, the most this server takes is {limit}.")

    def _end(self, job: Job, status: Status) -> None:
        job.move(status)
        job.finished = job.finished or _now()
        if status is Status.SUCCESSFUL:
            job.progress, job.n_done = 1.0, 1
        self._say(job, DONE)

    def _say(self, job: Job, name: str = PROGRESS) -> None:
        self._store.save(job)
        self._events.publish(name, job.client, job.id, job_document(job))


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="milliseconds")
