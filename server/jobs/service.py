"""Where jobs are handed in, asked about and dismissed: ties store, engine, results and events together.

A job is one client's handle on shared, content-addressed work. Work stops only when no handle is left.
"""

import threading
from dataclasses import replace
from typing import Any
from uuid import uuid4

from vfcore.errors import ParameterError
from vfcore.runs.result import SimulationResult
from vfcore.runs.sweep.document import sweep_from_dict
from vfcore.runs.sweep.table import SweepTable
from vfcore.spec.address import address
from vfcore.spec.request import document_of, resolve
from vocalis.server.jobs.archive import Archive
from vocalis.server.jobs.document import job_document
from vocalis.server.jobs.events import DONE, PROGRESS, Event
from vocalis.server.jobs.model import (
    ACTIVE,
    Job,
    NoSuchJob,
    NotFinished,
    QueueFull,
    ResultGone,
    Status,
    WrongKind,
)
from vocalis.server.jobs.points import PointStore
from vocalis.server.jobs.recorder import Ledger, now
from vocalis.server.jobs.scheduler import Engine
from vocalis.server.jobs.store import JobStore, KeyUse
from vocalis.server.jobs.sweep_work import SweepWork
from vocalis.server.jobs.work import Work

STALE = "An earlier version of Vocalis made this result and addressed it otherwise; the same request makes it again."


class Desk:
    """Thread-safe. ``per_client`` and ``queue_length`` bound the unfinished jobs."""

    def __init__(
        self, ledger: Ledger, store: JobStore, points: PointStore, archive: Archive, engine: Engine,
        per_client: int, queue_length: int,
    ):  # fmt: skip
        self._ledger, self._store, self._points, self._archive = ledger, store, points, archive
        self._per_client, self._queue_length = per_client, queue_length
        self._lock: threading.RLock = ledger.lock
        self.engine = engine

    def resume(self) -> None:
        """Go on with the jobs a server before this one left unfinished: each computation once."""
        with self._lock:
            begun: set[str] = set()
            for job in self._store.active():
                if job.status is Status.RUNNING:
                    job.move(Status.ACCEPTED)
                    self._store.save(job)
                if job.work_id in begun:
                    continue
                begun.add(job.work_id)
                if address_of(job.request) != job.content:  # of an earlier version: nothing it stored is used
                    self._readdress(job)
                    begun.add(job.work_id)
                if job.kind == "simulation" and not job.fresh and self._archive.is_kept(job.content):
                    self._ledger.finished(job.work_id, None)
                else:
                    self._begin(job)

    def _readdress(self, job: Job) -> None:
        """Begin an unfinished job again at the address that this version gives its request."""
        content, work_id = address_of(job.request), uuid4().hex
        for handle in self._store.handles(job.work_id):
            handle.content, handle.work_id = content, work_id
            handle.n_done, handle.n_failed, handle.progress = 0, 0, 0.0
            self._store.readdress(handle)

    def submit(
        self, client: str, request: dict[str, Any], fresh: bool = False, key: str | None = None, n_total: int = 1
    ) -> Job:
        """A job for a canonical request: the one this client already has, or a new one.

        Raises QueueFull at a limit, StorageFull, ParameterError when the Idempotency-Key was used for another request.
        """
        content = address_of(request)
        with self._lock:
            if key is not None and (known := self._recall(client, key, content)) is not None:
                return known
            job = None if fresh else self._same(client, request["kind"], content)
            if job is None:
                return self._new(Job(uuid4().hex, client, request["kind"], request, content, uuid4().hex, now(),
                                     n_total=n_total, fresh=fresh), key)  # fmt: skip
            if key is not None:
                self._store.remember(client, key, KeyUse(content, job.id))
            return job

    def job(self, job_id: str) -> Job:
        """A job by its id, or a finished one standing for a synchronous run; NoSuchJob."""
        with self._lock:
            if (job := self._store.get(job_id)) is not None:
                return job
        if (result := self._archive.get(job_id)) is not None:
            made = result.provenance.created
            return Job(
                job_id, "", "simulation", document_of(result.request), job_id, job_id, made,
                status=Status.SUCCESSFUL, progress=1.0, n_done=1, started=made, finished=made,
            )  # fmt: skip
        raise NoSuchJob(f"There is no job or kept result with the id {job_id!r}.")

    def jobs(
        self, client: str, status: Status | None, kind: str | None, limit: int, before: int | None
    ) -> tuple[list[Job], bool]:
        """Jobs of a client, newest first, and whether there are more."""
        with self._lock:
            return self._store.page(client, status, kind, limit, before)

    def result(self, job: Job) -> SimulationResult:
        """The result of a finished simulation; WrongKind, NotFinished or ResultGone."""
        if job.kind != "simulation":
            raise WrongKind(
                "A sweep has its scalars at /result, result.nc and result.csv; arrays and sound are those of one run."
            )
        _check_finished(job)
        request = resolve(job.request)
        if address(request) != job.content:
            raise ResultGone(STALE)
        if (result := self._archive.get(job.content)) is None:
            raise ResultGone("The result made room for newer ones; the same request makes it again.")
        return replace(result, request=request)  # in the words of this job

    def table(self, job: Job, partial: bool = False) -> SweepTable:
        """The table of a sweep: of a finished one, or with ``partial`` what there is. NotFinished."""
        if not partial or job.status not in ACTIVE:
            _check_finished(job)
        sweep = sweep_from_dict(job.request)
        if sweep.content != job.content:
            raise ResultGone(STALE)
        table = SweepTable(sweep)
        return table.fill(self._points.rows(job.work_id, len(table.columns)))

    def dismiss(self, job_id: str) -> Job:
        """Let go of a job; its work stops when nobody else waits for it. Doing it again changes nothing."""
        with self._lock:
            job = self._store.get(job_id)
            if job is None:
                raise NoSuchJob(f"There is no job with the id {job_id!r}.")
            if job.status is not Status.DISMISSED:
                was_active = job.status in ACTIVE
                self._ledger.end(job, Status.DISMISSED)
                if was_active and not self._store.handles(job.work_id):
                    self.engine.stop(job.work_id)
            return job

    def present(self, client: str, job_id: str | None) -> list[Event]:
        """The present state of a job, or of a client's unfinished jobs, as events outside the log."""
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
        return job if job and job.content == content else None  # an earlier version's result is made again

    def _same(self, client: str, kind: str, content: str) -> Job | None:
        has_result = kind == "sweep" or self._archive.has(content)
        wanted = (*ACTIVE, Status.SUCCESSFUL) if has_result else ACTIVE
        return self._store.latest(content, wanted, client)

    def _new(self, job: Job, key: str | None) -> Job:
        """Take a job: with its result at once, beside others that wait for the same work, or with work of its own."""
        if not job.fresh:
            if job.kind == "simulation" and (result := self._archive.get(job.content)) is not None:
                if not self._archive.is_kept(job.content):
                    self._archive.put(job.content, result)
                return self._finished_at_once(job, key)
            if job.kind == "sweep" and (done := self._store.latest(job.content, (Status.SUCCESSFUL,))) is not None:
                job.work_id, job.n_failed = done.work_id, done.n_failed
                return self._finished_at_once(job, key)
        self._check_limits(job.client)
        shared = None if job.fresh else self._store.latest(job.content, ACTIVE)
        if shared:
            job.work_id, job.status, job.started = shared.work_id, shared.status, shared.started
            job.progress, job.n_done, job.n_failed = shared.progress, shared.n_done, shared.n_failed
        self._store.add(job, key)
        self._ledger.say(job)
        if not shared:
            self._begin(job)
        return job

    def _finished_at_once(self, job: Job, key: str | None) -> Job:
        self._store.add(job, key)
        job.started = job.created
        self._ledger.end(job, Status.SUCCESSFUL)
        return job

    def _begin(self, job: Job) -> None:
        if job.kind == "sweep":
            self.engine.submit_sweep(SweepWork(job.work_id, job.request, job.fresh))
        else:
            self.engine.submit(Work(job.work_id, job.kind, job.request))

    def _check_limits(self, client: str) -> None:
        for count, limit, name in (
            (self._store.count_active(client), self._per_client, "unfinished jobs of one client"),
            (self.engine.waiting, self._queue_length, "jobs in the queue"),
        ):
            if count >= limit:
                raise QueueFull(f"There are {count} {name}, the most this server takes is {limit}.")


def address_of(request: dict[str, Any]) -> str:
    """The address of a canonical request of either kind."""
    if request["kind"] == "sweep":
        return sweep_from_dict(request).content
    return address(resolve(request))


def _check_finished(job: Job) -> None:
    if job.status is not Status.SUCCESSFUL:
        why = f": {job.problem['detail']}" if job.problem else "."
        raise NotFinished(f"The job is {job.status}{why}")
