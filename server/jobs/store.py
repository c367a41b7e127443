"""Where jobs are kept: in memory, behind the few calls that a database would have to answer.

Not thread-safe on its own: the desk holds its lock around every call. ``save`` is called after every change
of a job, so that a store on disk needs nothing else.
"""

from collections.abc import Collection, Iterator
from itertools import count, islice
from typing import NamedTuple

from vocalis_server.jobs.model import ACTIVE, Job, Status


class KeyUse(NamedTuple):
    """What an Idempotency-Key was first used for."""

    content: str
    job_id: str


class JobStore:
    """Jobs by id, newest last; the oldest finished ones are forgotten beyond ``kept``."""

    def __init__(self, kept: int):
        self._kept = kept
        self._jobs: dict[str, Job] = {}
        self._keys: dict[tuple[str, str], KeyUse] = {}
        self._numbers = count(1)

    def add(self, job: Job) -> None:
        """Take a new job, and give it its place in the order."""
        job.sequence = next(self._numbers)
        self._jobs[job.id] = job
        self._forget()

    def save(self, job: Job) -> None:
        """Keep a change of a job."""

    def get(self, job_id: str) -> Job | None:
        return self._jobs.get(job_id)

    def handles(self, work_id: str) -> list[Job]:
        """Unfinished jobs that wait for one computation."""
        return [job for job in self._jobs.values() if job.work_id == work_id and job.status in ACTIVE]

    def latest(self, content: str, statuses: Collection[Status], client: str | None = None) -> Job | None:
        """The newest job for a content in one of the states, of one client or of any."""
        found = self._newest_first(client)
        return next((job for job in found if job.content == content and job.status in statuses), None)

    def page(
        self, client: str, status: Status | None, kind: str | None, limit: int, before: int | None
    ) -> tuple[list[Job], bool]:
        """At most ``limit`` jobs of a client, newest first, older than number ``before``; and whether more follow."""
        found = (
            job
            for job in self._newest_first(client)
            if status in (None, job.status) and kind in (None, job.kind) and (before is None or job.sequence < before)
        )
        jobs = list(islice(found, limit + 1))
        return jobs[:limit], len(jobs) > limit

    def count_active(self, client: str | None = None) -> int:
        return sum(job.status in ACTIVE for job in self._newest_first(client))

    def recall(self, client: str, key: str) -> KeyUse | None:
        """What a client used an Idempotency-Key for; None when it is new or its job is forgotten."""
        return self._keys.get((client, key))

    def remember(self, client: str, key: str, use: KeyUse) -> None:
        self._keys[client, key] = use

    def _newest_first(self, client: str | None) -> Iterator[Job]:
        return (job for job in reversed(self._jobs.values()) if client in (None, job.client))

    def _forget(self) -> None:
        finished = [job.id for job in self._jobs.values() if job.status not in ACTIVE]
        if len(finished) <= self._kept:
            return
        for job_id in finished[: len(finished) - self._kept]:
            del self._jobs[job_id]
        self._keys = {pair: use for pair, use in self._keys.items() if use.job_id in self._jobs}
