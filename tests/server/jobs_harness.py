"""The job service with its real database, and a scheduler that computes only what a test tells it to."""

from pathlib import Path
from typing import Any

from vocalis.server.jobs.events import EventLog
from vocalis.server.jobs.kinds.registry import result_formats
from vocalis.server.jobs.kinds.simulation import SIMULATION
from vocalis.server.jobs.model import Job
from vocalis.server.jobs.recorder import JobRecorder
from vocalis.server.jobs.retention import Limits
from vocalis.server.jobs.service import JobService
from vocalis.server.jobs.storage import Storage
from vocalis.server.jobs.work import Work


class IdleScheduler:
    """Takes work and does nothing with it."""

    def __init__(self) -> None:
        self.work: dict[str, Work] = {}
        self.waiting = 0

    def submit(self, work: Work) -> None:
        assert work.id not in self.work, "one computation, however many jobs wait for it"
        self.work[work.id] = work

    def stop(self, work_id: str) -> None:
        self.work.pop(work_id, None)


class JobSystem:
    """One server's jobs without the server. ``JobSystem(folder)`` again after ``close`` is a restart."""

    def __init__(self, folder: Path, per_client: int = 1000, limits: Limits = Limits(1000, 90, 2**30, 10**6)):  # noqa: B008
        self.events = EventLog()
        self.storage = Storage(folder, 2**20, limits, result_formats())
        self.recorder = JobRecorder(self.storage.jobs, self.events)
        self.scheduler = IdleScheduler()
        self.jobs = JobService(self.recorder, self.storage, self.scheduler, per_client, 1000)
        self.storage.open()
        self.jobs.resume()

    def finish(self, job: Job, result: Any) -> None:
        """Let the work of a single run begin and end with a result."""
        self.recorder.started(job.work_id)
        self.recorder.finished(job.work_id, lambda: self.storage.results.store(job.content, result))

    def result(self, job: Job) -> Any:
        return SIMULATION.load(job, self.storage)

    def close(self) -> None:
        self.storage.close()
