"""The folder with jobs and results; one server at a time uses it."""

import fcntl
import os
from pathlib import Path

DATABASE, RESULTS, LOCK = "jobs.sqlite", "results", "lock"
MOST_SERVERS = 100


class Folder:
    """A folder that no other server uses while this one holds its lock; the system releases it however a server ends.

    ``wanted`` itself, or when another server has it ``wanted-2``, ``wanted-3``, …: every server runs the jobs it
    accepted, none runs another's. ``number`` tells which one it is; 0 before ``open``.
    """

    def __init__(self, wanted: Path):
        self._wanted, self._lock = wanted, -1
        self.path, self.number = wanted, 0

    def open(self) -> None:
        """Take the folder, and create it if it does not exist. OSError where that cannot be."""
        for self.number in range(1, MOST_SERVERS + 1):
            self.path = self._numbered()
            self.results.mkdir(parents=True, exist_ok=True)
            self._lock = os.open(self.path / LOCK, os.O_RDWR | os.O_CREAT, 0o600)
            try:
                fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                return
            except BlockingIOError:
                os.close(self._lock)
        raise OSError(f"{MOST_SERVERS} servers use {self._wanted} already")

    def _numbered(self) -> Path:
        wanted = self._wanted
        return wanted if self.number == 1 else wanted.with_name(f"{wanted.name}-{self.number}")

    @property
    def database(self) -> Path:
        return self.path / DATABASE

    @property
    def results(self) -> Path:
        return self.path / RESULTS

    def close(self) -> None:
        """Release the folder for other servers."""
        if self._lock >= 0:
            os.close(self._lock)
            self._lock = -1
