"""Everything a server keeps: jobs, points of sweeps and whole results, in one folder."""

from collections.abc import Sequence
from pathlib import Path

from vocalis.server.jobs.archive import Archive, ResultFormat
from vocalis.server.jobs.database import Database
from vocalis.server.jobs.folder import Folder
from vocalis.server.jobs.points import PointStore
from vocalis.server.jobs.retention import Limits, Retention
from vocalis.server.jobs.store import JobStore


class Storage:
    """``directory``: the wanted folder; ``memory_bytes``: for results in memory; ``formats`` of results."""

    def __init__(self, directory: Path, memory_bytes: int, limits: Limits, formats: Sequence[ResultFormat]):
        self.folder = Folder(directory)
        self.database = Database()
        self.jobs = JobStore(self.database)
        self.points = PointStore(self.database)
        self.results = Archive(self.database, self.folder, memory_bytes, formats)
        self.retention = Retention(self.database, self.results, self.folder, limits)

    def open(self) -> None:
        """Take the folder and read the unfinished jobs in it. OSError or StorageUnusable where that cannot be."""
        if self.folder.number == 0:
            self.folder.open()
            self.database.open(self.folder.database)
            self.jobs.load()
            self.retention.adopt()
            self.retention.tidy()

    def close(self) -> None:
        """Let another server have the folder."""
        self.retention.close()
        self.database.close()
        self.folder.close()
