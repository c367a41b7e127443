"""The journal of a sweep: the points computed so far, in a file from which an interrupted run resumes."""

import os
import sqlite3
from collections.abc import Iterator, Sequence

from vfcore.errors import ParameterError
from vfcore.runs.sweep.plan import Sweep
from vfcore.runs.sweep.row import Row, decode, encode
from vfcore.version import MODEL_VERSION

_TABLES = """
CREATE TABLE IF NOT EXISTS sweep (model TEXT NOT NULL, content TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS points (position INTEGER PRIMARY KEY, row BLOB NOT NULL);
"""


class Journal:
    """Rows by position in a SQLite file at ``path``, created if missing.

    Raises ParameterError if the file is not a journal, or belongs to another sweep or model.
    """

    def __init__(self, path: str | os.PathLike, sweep: Sweep):
        self.path = os.fspath(path)
        wanted = (MODEL_VERSION, sweep.content)
        try:
            self._file = sqlite3.connect(self.path)
            self._file.executescript(_TABLES)
            with self._file:
                found = self._file.execute("SELECT * FROM sweep").fetchone()
                if found is None:
                    self._file.execute("INSERT INTO sweep VALUES (?, ?)", wanted)
        except sqlite3.Error as error:
            raise ParameterError("--resume", f"{self.path}: {error}", "a journal of a sweep, or a new file") from error
        if found not in (None, wanted):
            what = "model" if found[0] != MODEL_VERSION else "sweep"
            raise ParameterError(
                "--resume", f"{self.path} is of another {what}", "the journal of this sweep, or a new file"
            )

    def rows(self) -> Iterator[tuple[int, Row]]:
        """All stored points."""
        for position, data in self._file.execute("SELECT position, row FROM points"):
            yield position, decode(data)

    def put(self, positions: Sequence[int], rows: Sequence[Row]) -> None:
        """Store points, all or none; OSError where the disk is full."""
        try:
            with self._file:
                self._file.executemany(
                    "INSERT OR REPLACE INTO points VALUES (?, ?)",
                    [(position, encode(row)) for position, row in zip(positions, rows, strict=True)],
                )
        except sqlite3.OperationalError as error:
            raise OSError(f"{self.path}: {error}") from error

    def close(self) -> None:
        self._file.close()

    def remove(self) -> None:
        """Close and delete the file: the sweep is complete and written elsewhere."""
        self.close()
        os.unlink(self.path)
