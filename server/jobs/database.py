"""SQLite behind SQLAlchemy: opened by one server, written by one thread at a time; StorageFull when a disk is full.

Write-ahead log with ``synchronous=NORMAL``: committed transactions survive the end of the process in any form. A power
cut may lose the latest ones, but never damages the file.
"""

import errno
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from sqlalchemy import Connection, Engine, create_engine, event, text
from sqlalchemy.exc import DBAPIError

from vocalis.server.exceptions import StorageFull, StorageUnusable
from vocalis.server.jobs.tables import LAYOUT, METADATA

_FULL = ("disk is full", "disk I/O error", "database is full")
_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


class Database:
    """``read()`` and ``write()`` give a connection; StorageFull where the disk has no room."""

    def __init__(self) -> None:
        self._path: Path
        self._engine: Engine
        self._writing = threading.RLock()

    def open(self, path: Path) -> None:
        """Open the file, and create it if it does not exist; StorageUnusable when it has another layout."""
        self._path = path
        self._engine = create_engine(f"sqlite:///{path}", connect_args={"timeout": 10})
        event.listen(self._engine, "connect", _prepare)
        with self.write() as connection:
            METADATA.create_all(connection)
            layout = connection.execute(text("PRAGMA user_version")).scalar_one()
            if layout not in (0, LAYOUT):
                raise StorageUnusable(f"{path} is of another version of Vocalis; move it away or name another folder.")
            connection.execute(text(f"PRAGMA user_version = {LAYOUT}"))

    @contextmanager
    def read(self) -> Iterator[Connection]:
        """A connection that sees one state of the database."""
        with translate_storage_errors(self._path), self._engine.connect() as connection:
            yield connection

    @contextmanager
    def write(self) -> Iterator[Connection]:
        """A transaction: all of it is committed, or nothing."""
        with translate_storage_errors(self._path), self._writing, self._engine.begin() as connection:
            yield connection

    def close(self) -> None:
        self._engine.dispose()


@contextmanager
def translate_storage_errors(path: Path) -> Iterator[None]:
    """StorageFull in place of the errors that a full disk raises."""
    try:
        yield
    except DBAPIError as error:
        if any(text in str(error.orig) for text in _FULL):
            raise StorageFull(_sentence(path)) from error
        raise
    except OSError as error:
        if error.errno in _NO_ROOM:
            raise StorageFull(_sentence(path)) from error
        raise


def _sentence(path: Path) -> str:
    folder = path if path.is_dir() else path.parent
    return f"There is no room left to keep jobs and results (in {folder}); what is stored already is not touched."


def _prepare(connection, _) -> None:
    for pragma in ("journal_mode=WAL", "synchronous=NORMAL", "foreign_keys=ON", "journal_size_limit=67108864"):
        connection.execute(f"PRAGMA {pragma}").close()
