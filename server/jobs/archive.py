"""Whole results: on disk by content address, the most recently used ones in memory too."""

import json
import os
import re
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Protocol

from sqlalchemy import delete, func, select, update
from sqlalchemy.dialects.sqlite import insert

from vfcore.io.atomic import replacing
from vfcore.io.result_document import json_text
from vfcore.io.stored import DamagedFile
from vocalis.server.jobs.cache import LruCache
from vocalis.server.jobs.database import Database, translate_storage_errors
from vocalis.server.jobs.folder import Folder
from vocalis.server.jobs.tables import RESULTS

_ADDRESS = re.compile(r"[0-9a-f]{32}")  # a client's string becomes a file name


class ResultFormat(Protocol):
    """How one type of result is kept as a file. ``ending`` tells the files of one format from those of another."""

    result_type: type[Any]
    ending: str

    def save(self, result: Any, path: Path) -> int:
        """Write the file whole or not at all; its size in bytes. OSError."""

    def load(self, path: Path) -> Any:
        """The result that was saved; FileNotFoundError, DamagedFile."""

    def size_bytes(self, result: Any) -> int:
        """Memory that a result takes."""

    def address(self, result: Any) -> str | None:
        """The content address that this version gives a result; None when the result does not tell."""


class DocumentFormat:
    """Results that are plain documents, as JSON."""

    result_type: type[Any] = dict
    ending = ".json"

    def save(self, result: dict[str, Any], path: Path) -> int:
        with replacing(path) as draft:
            with open(draft, "w", encoding="utf-8") as file:
                file.write(json_text(result))
                file.flush()
                os.fsync(file.fileno())
            return draft.stat().st_size

    def load(self, path: Path) -> dict[str, Any]:
        try:
            return json.loads(path.read_text(encoding="utf-8"))
        except ValueError as error:
            raise DamagedFile(f"{path} cannot be read back: {error}") from error

    def size_bytes(self, result: dict[str, Any]) -> int:
        return len(json_text(result))

    def address(self, result: dict[str, Any]) -> None:
        return None


class Archive:
    """Thread-safe. What was only ``cache``d is in memory; what was ``store``d survives the server."""

    def __init__(self, database: Database, folder: Folder, memory_bytes: int, formats: Sequence[ResultFormat]):
        self._database, self._folder, self._formats = database, folder, tuple(formats)
        self._memory: LruCache[Any] = LruCache(memory_bytes, lambda result: self._format_of(result).size_bytes(result))

    @property
    def endings(self) -> tuple[str, ...]:
        """The endings of the files of results."""
        return tuple(form.ending for form in self._formats)

    def cache(self, content: str, result: Any) -> None:
        """Keep a result in memory, as long as there is room."""
        self._memory.put(content, result)

    def store(self, content: str, result: Any) -> None:
        """Keep a result on disk; StorageFull where there is no room."""
        form = self._format_of(result)
        self._memory.put(content, result)
        with translate_storage_errors(self._folder.results):
            size = form.save(result, self._path(content, form))
        row = insert(RESULTS).values(content=content, bytes=size, used=time.time())
        with self._database.write() as connection:
            connection.execute(
                row.on_conflict_do_update(
                    index_elements=["content"], set_={"bytes": row.excluded.bytes, "used": row.excluded.used}
                )
            )

    def get(self, content: str) -> Any | None:
        """A result from memory or disk; None when it is in neither. A damaged file counts as none."""
        if not _ADDRESS.fullmatch(content):
            return None
        if (found := self._memory.get(content)) is not None:
            return found
        try:
            result = self._load(content)
        except DamagedFile:
            result = None
            self.drop([content])
        if result is None:
            return None
        self._memory.put(content, result)
        with self._database.write() as connection:
            connection.execute(update(RESULTS).where(RESULTS.c.content == content).values(used=time.time()))
        return result

    def has(self, content: str) -> bool:
        """Whether a result is in memory or on disk, without reading it."""
        return self._memory.get(content) is not None or self.is_stored(content)

    def is_stored(self, content: str) -> bool:
        """Whether a result is on disk."""
        return any(self._path(content, form).exists() for form in self._formats)

    def drop(self, contents: list[str]) -> None:
        """Remove results from the disk."""
        with self._database.write() as connection:
            connection.execute(delete(RESULTS).where(RESULTS.c.content.in_(contents)))
        for content in contents:
            for form in self._formats:
                self._path(content, form).unlink(missing_ok=True)

    def total_bytes(self) -> int:
        """Size of the files of all results."""
        with self._database.read() as connection:
            return connection.execute(select(func.coalesce(func.sum(RESULTS.c.bytes), 0))).scalar_one()

    def _load(self, content: str) -> Any | None:
        """A result from disk; DamagedFile also for one of an earlier version, which had other addresses."""
        for form in self._formats:
            path = self._path(content, form)
            try:
                result = form.load(path)
            except FileNotFoundError:
                continue
            if form.address(result) not in (None, content):
                raise DamagedFile(f"{path} has the address of another version.")
            return result
        return None

    def _format_of(self, result: Any) -> ResultFormat:
        return next(form for form in self._formats if isinstance(result, form.result_type))

    def _path(self, content: str, form: ResultFormat) -> Path:
        return self._folder.results / f"{content}{form.ending}"
