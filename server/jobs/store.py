"""Jobs on disk, the unfinished ones in memory too, and the Idempotency-Keys they were submitted with.

Not thread-safe by itself: the job service and the recorder hold their common lock around every call. Progress is
frequent and kept in memory; ``save`` writes a job to disk.
"""

from collections.abc import Collection, Iterable
from dataclasses import fields
from typing import Any, NamedTuple

from sqlalchemy import Connection, bindparam, delete, insert, select, update

from vocalis.server.jobs.database import Database
from vocalis.server.jobs.model import ACTIVE, Job, Status
from vocalis.server.jobs.tables import JOBS, KEYS

_FIELDS = tuple(field.name for field in fields(Job))
_FIXED = {"id", "sequence", "client", "kind", "request", "content", "created"}
_CHANGING = tuple(name for name in _FIELDS if name not in _FIXED)
_COLUMNS = [JOBS.c[name] for name in _FIELDS]
_CHANGE = update(JOBS).where(JOBS.c.id == bindparam("job_id")).values({name: bindparam(name) for name in _CHANGING})


class KeyUse(NamedTuple):
    """What an Idempotency-Key was first used for."""

    content: str
    job_id: str


class JobStore:
    """Jobs by id; ``active()`` are those that a new server has to continue."""

    def __init__(self, database: Database):
        self._database = database
        self._active: dict[str, Job] = {}
        self._unsaved: dict[str, Job] = {}  # ended while the disk was full

    def load(self) -> None:
        """Read the jobs that the last server left unfinished."""
        with self._database.read() as connection:
            rows = connection.execute(select(*_COLUMNS).where(JOBS.c.status.in_(ACTIVE)).order_by(JOBS.c.sequence))
            self._active = {row.id: _job(row) for row in rows}

    def add(self, job: Job, key: str | None = None) -> None:
        """Take a new job, with the key it was submitted with, and give it its sequence number."""
        with self._database.write() as connection:
            values = _values(job)
            del values["sequence"]
            inserted = connection.execute(insert(JOBS).values(values)).inserted_primary_key
            job.sequence = inserted[0] if inserted else 0
            if key is not None:
                _store_key(connection, job.client, key, KeyUse(job.content, job.id))
        self._remember_job(job)

    def save(self, job: Job) -> None:
        """Store a change of a job, and earlier ones that could not be stored. In memory it holds on a full disk too."""
        self._remember_job(job)
        with self._database.write() as connection:
            save_jobs(connection, [job, *self._unsaved.values()])
        self._unsaved.clear()

    def active(self) -> list[Job]:
        """Unfinished jobs, oldest first."""
        return list(self._active.values())

    def readdress(self, job: Job) -> None:
        """Store the new address of a job and of the work it waits for."""
        with self._database.write() as connection:
            connection.execute(update(JOBS).where(JOBS.c.id == job.id).values(content=job.content))
            save_jobs(connection, [job])

    def get(self, job_id: str) -> Job | None:
        return self._in_memory(job_id) or self._first(JOBS.c.id == job_id)

    def handles(self, work_id: str) -> list[Job]:
        """Unfinished jobs that wait for one computation."""
        return [job for job in self._active.values() if job.work_id == work_id]

    def latest(self, content: str, statuses: Collection[Status], client: str | None = None) -> Job | None:
        """The newest job for a content in one of the states, of one client or of any."""
        found = [
            job
            for job in self._active.values()
            if job.content == content and job.status in statuses and client in (None, job.client)
        ]
        if found:
            return found[-1]
        ended = [status for status in statuses if status not in ACTIVE]
        if not ended:
            return None
        wanted = (JOBS.c.content == content) & JOBS.c.status.in_(ended)
        return self._first(wanted if client is None else wanted & (JOBS.c.client == client))

    def page(
        self, client: str, status: Status | None, kind: str | None, limit: int, before: int | None
    ) -> tuple[list[Job], bool]:
        """At most ``limit`` jobs of a client, newest first, older than number ``before``; and whether more follow."""
        wanted = select(*_COLUMNS).where(JOBS.c.client == client)
        for column, value in ((JOBS.c.status, status), (JOBS.c.kind, kind)):
            if value is not None:
                wanted = wanted.where(column == value)
        if before is not None:
            wanted = wanted.where(JOBS.c.sequence < before)
        with self._database.read() as connection:
            rows = connection.execute(wanted.order_by(JOBS.c.sequence.desc()).limit(limit + 1)).all()
        jobs = [self._in_memory(row.id) or _job(row) for row in rows]
        return jobs[:limit], len(jobs) > limit

    def count_active(self, client: str) -> int:
        return sum(job.client == client for job in self._active.values())

    def recall(self, client: str, key: str) -> KeyUse | None:
        """What a client used an Idempotency-Key for; None when it is new or its job is forgotten."""
        with self._database.read() as connection:
            row = connection.execute(
                select(KEYS.c.content, KEYS.c.job_id).where(KEYS.c.client == client, KEYS.c.key == key)
            ).first()
        return None if row is None else KeyUse(row.content, row.job_id)

    def remember(self, client: str, key: str, use: KeyUse) -> None:
        with self._database.write() as connection:
            _store_key(connection, client, key, use)

    def _first(self, wanted: Any) -> Job | None:
        with self._database.read() as connection:
            row = connection.execute(select(*_COLUMNS).where(wanted).order_by(JOBS.c.sequence.desc()).limit(1)).first()
        return None if row is None else _job(row)

    def _remember_job(self, job: Job) -> None:
        if job.status in ACTIVE:
            self._active[job.id] = job
        else:
            self._active.pop(job.id, None)
            self._unsaved[job.id] = job

    def _in_memory(self, job_id: str) -> Job | None:
        return self._active.get(job_id) or self._unsaved.get(job_id)


def save_jobs(connection: Connection, jobs: Iterable[Job]) -> None:
    """Store changes of jobs, inside a transaction."""
    for job in jobs:
        connection.execute(_CHANGE, _values(job, _CHANGING) | {"job_id": job.id})


def _store_key(connection: Connection, client: str, key: str, use: KeyUse) -> None:
    connection.execute(delete(KEYS).where(KEYS.c.client == client, KEYS.c.key == key))
    connection.execute(insert(KEYS).values(client=client, key=key, content=use.content, job_id=use.job_id))


def _values(job: Job, names: Iterable[str] = _FIELDS) -> dict[str, Any]:
    """Columns of a job; not a deep copy, as a request may hold ten thousand points."""
    return {name: getattr(job, name) for name in names} | {"status": job.status.value}


def _job(row: Any) -> Job:
    values = dict(row._mapping)
    return Job(**values | {"status": Status(values["status"])})
