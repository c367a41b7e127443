"""The desk with its real database, and an engine that computes only what a test tells it to."""

from pathlib import Path

from vocalis.server.jobs.archive import Archive
from vocalis.server.jobs.database import Database
from vocalis.server.jobs.events import EventLog
from vocalis.server.jobs.folder import Folder
from vocalis.server.jobs.points import PointStore
from vocalis.server.jobs.recorder import Ledger
from vocalis.server.jobs.retention import Limits, Retention
from vocalis.server.jobs.service import Desk
from vocalis.server.jobs.store import JobStore
from vocalis.server.jobs.sweep_work import InFlight, SweepWork
from vocalis.server.jobs.work import Work


class IdleEngine:
    """Takes work and does nothing with it."""

    def __init__(self) -> None:
        self.work: dict[str, Work | SweepWork] = {}
        self.in_flight = InFlight()
        self.waiting = 0

    def submit(self, work: Work) -> None:
        assert work.id not in self.work, "one computation, however many jobs wait for it"
        self.work[work.id] = work

    submit_sweep = submit

    def stop(self, work_id: str) -> None:
        self.work.pop(work_id, None)


class Shop:
    """One server's jobs without the server. ``Shop(folder)`` again after ``close`` is a restart."""

    def __init__(self, folder: Path, per_client: int = 1000, limits: Limits = Limits(1000, 90, 2**30, 10**6)):  # noqa: B008
        self.folder, self.database, self.events = Folder(folder), Database(), EventLog()
        self.store, self.points = JobStore(self.database), PointStore(self.database)
        self.archive = Archive(self.database, self.folder, 2**20)
        self.ledger = Ledger(self.store, self.points, self.archive, self.events)
        self.engine = IdleEngine()
        self.desk = Desk(self.ledger, self.store, self.points, self.archive, self.engine, per_client, 1000)
        self.retention = Retention(self.database, self.archive, self.folder, limits)
        self.folder.open()
        self.database.open(self.folder.database)
        self.store.load()
        self.retention.adopt()
        self.desk.resume()

    def close(self) -> None:
        self.database.close()
        self.folder.close()
