"""Whole results: on disk by content, the ones used last in memory too."""

import re
import time
from pathlib import Path

from sqlalchemy import delete, func, select, update
from sqlalchemy.dialects.sqlite import insert

from vfcore.io.stored import DamagedFile, load_result, save_result
from vfcore.runs.result import SimulationResult
from vfcore.spec.address import address
from vocalis.server.jobs.database import Database, told_plainly
from vocalis.server.jobs.folder import Folder
from vocalis.server.jobs.results import ResultCache
from vocalis.server.jobs.tables import RESULTS

ENDING = ".npz"
_ADDRESS = re.compile(r"[0-9a-f]{32}")  # what a client asks for becomes a file name


class Archive:
    """Thread-safe. What only ``show`` was given lives in memory; what was ``put`` survives the server."""

    def __init__(self, database: Database, folder: Folder, memory_bytes: int):
        self._database, self._folder = database, folder
        self._memory = ResultCache(memory_bytes)

    def show(self, content: str, result: SimulationResult) -> None:
        """Keep a result in memory, as long as there is room."""
        self._memory.put(content, result)

    def put(self, content: str, result: SimulationResult) -> None:
        """Keep a result on disk; StorageFull where there is no room."""
        self._memory.put(content, result)
        with told_plainly(self._folder.results):
            size = save_result(result, self._path(content))
        row = insert(RESULTS).values(content=content, bytes=size, used=time.time())
        with self._database.write() as connection:
            connection.execute(
                row.on_conflict_do_update(
                    index_elements=["content"], set_={"bytes": row.excluded.bytes, "used": row.excluded.used}
                )
            )

    def get(self, content: str) -> SimulationResult | None:
        """A result from memory or disk; None when it is in neither (any more). A damaged file counts as none."""
        if not _ADDRESS.fullmatch(content):
            return None
        if (found := self._memory.get(content)) is not None:
            return found
        try:
            result = load_result(self._path(content))
        except FileNotFoundError:
            return None
        except DamagedFile:
            self.drop([content])
            return None
        if address(result.request) != content:  # of an earlier version, which addressed its results otherwise
            self.drop([content])
            return None
        self._memory.put(content, result)
        with self._database.write() as connection:
            connection.execute(update(RESULTS).where(RESULTS.c.content == content).values(used=time.time()))
        return result

    def has(self, content: str) -> bool:
        """Whether a result is at hand, without reading it."""
        return self._memory.get(content) is not None or self._path(content).exists()

    def is_kept(self, content: str) -> bool:
        """Whether a result is on disk."""
        return self._path(content).exists()

    def drop(self, contents: list[str]) -> None:
        """Remove results from the disk."""
        with self._database.write() as connection:
            connection.execute(delete(RESULTS).where(RESULTS.c.content.in_(contents)))
        for content in contents:
            self._path(content).unlink(missing_ok=True)

    def total_bytes(self) -> int:
        with self._database.read() as connection:
            return connection.execute(select(func.coalesce(func.sum(RESULTS.c.bytes), 0))).scalar_one()

    def _path(self, content: str) -> Path:
        return self._folder.results / f"{content}{ENDING}"
