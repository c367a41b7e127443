"""Accepts jobs, finds them, lists them and dismisses them.

A job is one client's handle on shared, content-addressed work. Work stops only when no handle is left.
"""

from typing import Any
from uuid import uuid4

from vfcore.errors import ParameterError, VocalisError
from vocalis.server.exceptions import NoSuchJob, QueueFull
from vocalis.server.jobs.document import job_document
from vocalis.server.jobs.events import DONE, PROGRESS, Event
from vocalis.server.jobs.kinds.registry import KINDS, address_of, kind_named, kind_of
from vocalis.server.jobs.model import ACTIVE, Job, Status
from vocalis.server.jobs.recorder import JobRecorder, now
from vocalis.server.jobs.scheduler import Scheduler
from vocalis.server.jobs.storage import Storage
from vocalis.server.jobs.store import KeyUse
from vocalis.server.problems import problem_of


class JobService:
    """Thread-safe. ``per_client`` and ``queue_length`` limit the unfinished jobs."""

    def __init__(
        self, recorder: JobRecorder, storage: Storage, scheduler: Scheduler, per_client: int, queue_length: int
    ):
        self._recorder, self._storage, self._store = recorder, storage, storage.jobs
        self._per_client, self._queue_length = per_client, queue_length
        self._lock = recorder.lock
        self.scheduler = scheduler

    def resume(self) -> None:
        """Continue the jobs that the last server left unfinished: each computation once."""
        with self._lock:
            begun: set[str] = set()
            for job in self._store.active():
                if job.status is Status.RUNNING:
                    job.move(Status.ACCEPTED)
                    self._store.save(job)
                if job.work_id in begun:
                    continue
                begun.add(job.work_id)
                try:
                    self._resume_work(job)
                except VocalisError as error:  # this version does not take the request
                    self._recorder.failed(job.work_id, problem_of(error))
                begun.add(job.work_id)

    def _resume_work(self, job: Job) -> None:
        if address_of(job.request) != job.content:  # of an earlier version: nothing it stored is used
            self._readdress(job)
        if kind_named(job.kind).is_answered(job, self._storage):
            self._recorder.finished(job.work_id)
        else:
            self._begin(job)

    def _readdress(self, job: Job) -> None:
        """Begin an unfinished job again, at the address that this version gives its request."""
        content, work_id = address_of(job.request), uuid4().hex
        for handle in self._store.handles(job.work_id):
            handle.content, handle.work_id = content, work_id
            handle.n_done, handle.n_failed, handle.progress = 0, 0, 0.0
            self._store.readdress(handle)

    def submit(self, client: str, request: dict[str, Any], fresh: bool = False, key: str | None = None) -> Job:
        """A job for a canonical request: the one this client already has, or a new one.

        Raises QueueFull at a limit, StorageFull, ParameterError when the Idempotency-Key was used for another request.
        """
        kind = kind_of(request)
        wanted = kind.parse(request)
        content = kind.address(wanted)
        with self._lock:
            if key is not None and (known := self._recall(client, key, content)) is not None:
                return known
            job = None if fresh else self._same(client, content, kind.has_answer(wanted, self._storage))
            if job is None:
                return self._new(Job(uuid4().hex, client, kind.name, request, content, uuid4().hex, now(),
                                     n_total=kind.n_total(wanted), fresh=fresh), key)  # fmt: skip
            if key is not None:
                self._store.remember(client, key, KeyUse(content, job.id))
            return job

    def job(self, job_id: str) -> Job:
        """A job by its id, or by its content address a kept result of a synchronous run; NoSuchJob."""
        with self._lock:
            if (job := self._store.get(job_id)) is not None:
                return job
        for kind in KINDS.values():
            if (job := kind.job_of_result(job_id, self._storage)) is not None:
                return job
        raise NoSuchJob(f"There is no job or kept result with the id {job_id!r}.")

    def jobs(
        self, client: str, status: Status | None, kind: str | None, limit: int, before: int | None
    ) -> tuple[list[Job], bool]:
        """Jobs of a client, newest first, and whether there are more."""
        with self._lock:
            return self._store.page(client, status, kind, limit, before)

    def dismiss(self, job_id: str) -> Job:
        """Dismiss a job; its work stops when no other job waits for it. A second call changes nothing."""
        with self._lock:
            job = self._store.get(job_id)
            if job is None:
                raise NoSuchJob(f"There is no job with the id {job_id!r}.")
            if job.status is not Status.DISMISSED:
                was_active = job.status in ACTIVE
                self._recorder.end(job, Status.DISMISSED)
                if was_active and not self._store.handles(job.work_id):
                    self.scheduler.stop(job.work_id)
            return job

    def present(self, client: str, job_id: str | None) -> list[Event]:
        """The present state of a job, or of a client's unfinished jobs, as events that are not in the log."""
        with self._lock:
            if job_id is not None:
                jobs = [self.job(job_id)]
            else:
                jobs = [job for job in self._store.active() if job.client == client]
            return [
                Event("", PROGRESS if job.status in ACTIVE else DONE, client, job.id, job_document(job, brief=True))
                for job in jobs
            ]

    def _recall(self, client: str, key: str, content: str) -> Job | None:
        use = self._store.recall(client, key)
        if use is None:
            return None
        job = self._store.get(use.job_id)
        if content != (use.content if job is None else address_of(job.request)):
            raise ParameterError("Idempotency-Key", "was used for another request", "a new key, or the same request")
        return job if job and job.content == content else None  # the result of an earlier version is made again

    def _same(self, client: str, content: str, has_answer: bool) -> Job | None:
        return self._store.latest(content, (*ACTIVE, Status.SUCCESSFUL) if has_answer else ACTIVE, client)

    def _new(self, job: Job, key: str | None) -> Job:
        """Take a job: with a stored answer, as a further handle on the same work, or with new work."""
        if not job.fresh and kind_named(job.kind).take_answer(job, self._storage):
            self._store.add(job, key)
            job.started = job.created
            self._recorder.end(job, Status.SUCCESSFUL)
            return job
        self._check_limits(job.client)
        shared = None if job.fresh else self._store.latest(job.content, ACTIVE)
        if shared:
            job.work_id, job.status, job.started = shared.work_id, shared.status, shared.started
            job.progress, job.n_done, job.n_failed = shared.progress, shared.n_done, shared.n_failed
        self._store.add(job, key)
        self._recorder.publish(job)
        if not shared:
            self._begin(job)
        return job

    def _begin(self, job: Job) -> None:
        self.scheduler.submit(kind_named(job.kind).work(job, self._storage, self._recorder))

    def _check_limits(self, client: str) -> None:
        for count, limit, name in (
            (self._store.count_active(client), self._per_client, "unfinished jobs of one client"),
            (self.scheduler.waiting, self._queue_length, "jobs in the queue"),
        ):
            if count >= limit:
                raise QueueFull(f"There are {count} {name}; this server takes at most {limit}.")
