"""What is kept, and for how long: limits on age, number and size. Work under way is never touched."""

import threading
import time
from datetime import UTC, datetime, timedelta
from typing import NamedTuple

from sqlalchemy import delete, exists, func, select
from sqlalchemy.dialects.sqlite import insert

from vocalis.server.exceptions import StorageFull
from vocalis.server.jobs.archive import Archive
from vocalis.server.jobs.database import Database
from vocalis.server.jobs.folder import Folder
from vocalis.server.jobs.model import ACTIVE
from vocalis.server.jobs.tables import JOBS, KEYS, MEMBERS, POINTS, RESULTS

EVERY_S = 60.0


class Limits(NamedTuple):
    """``jobs``: finished ones; ``days``: for jobs and for unused results; ``points``: rows."""

    jobs: int
    days: float
    result_bytes: int
    points: int


class Retention:
    """Applies the limits every minute, in a thread of its own."""

    def __init__(self, database: Database, archive: Archive, folder: Folder, limits: Limits):
        self._database, self._archive, self._folder, self._limits = database, archive, folder, limits
        self._end = threading.Event()

    def start(self) -> None:
        threading.Thread(target=self._serve, name="retention", daemon=True).start()

    def close(self) -> None:
        self._end.set()

    def tidy(self) -> None:
        """Remove what is beyond the limits."""
        self._remove_jobs()
        self._remove_points()
        self._remove_results()

    def adopt(self) -> None:
        """Add rows for results that were written just before a server ended, and remove unfinished files."""
        with self._database.read() as connection:
            known = set(connection.scalars(select(RESULTS.c.content)))
        for path in self._folder.results.iterdir():
            if path.is_dir():  # of vfcore.io.atomic
                for draft in path.iterdir():
                    draft.unlink()
                path.rmdir()
            elif path.suffix in self._archive.endings and path.stem not in known:
                with self._database.write() as connection:
                    connection.execute(
                        insert(RESULTS).values(content=path.stem, bytes=path.stat().st_size, used=time.time())
                    )

    def _serve(self) -> None:
        while not self._end.wait(EVERY_S):
            try:
                self.tidy()
            except StorageFull:  # removing needs a little room itself; clients that need more get the problem
                continue

    def _remove_jobs(self) -> None:
        over = JOBS.c.status.not_in(ACTIVE)
        before = (datetime.now(UTC) - timedelta(days=self._limits.days)).isoformat(timespec="milliseconds")
        newest = select(JOBS.c.sequence).where(over).order_by(JOBS.c.sequence.desc())
        with self._database.write() as connection:
            last_kept = connection.scalar(newest.offset(self._limits.jobs - 1).limit(1))
            connection.execute(
                delete(JOBS).where(over, (JOBS.c.finished < before) | (JOBS.c.sequence < (last_kept or 0)))
            )
            connection.execute(delete(KEYS).where(~exists().where(JOBS.c.id == KEYS.c.job_id)))
            connection.execute(delete(MEMBERS).where(~exists().where(JOBS.c.work_id == MEMBERS.c.work_id)))

    def _remove_points(self) -> None:
        """The oldest points that no sweep of a kept job has."""
        with self._database.write() as connection:
            surplus = connection.execute(select(func.count()).select_from(POINTS)).scalar_one() - self._limits.points
            if surplus > 0:
                unused = ~exists().where(MEMBERS.c.number == POINTS.c.number)
                oldest = select(POINTS.c.number).where(unused).order_by(POINTS.c.number).limit(surplus)
                connection.execute(delete(POINTS).where(POINTS.c.number.in_(oldest)))

    def _remove_results(self) -> None:
        """The least recently used ones, except those that a job under way needs."""
        old = time.time() - self._limits.days * 86400
        wanted = exists().where(JOBS.c.content == RESULTS.c.content, JOBS.c.status.in_(ACTIVE))
        with self._database.read() as connection:
            rows = connection.execute(
                select(RESULTS.c.content, RESULTS.c.bytes, RESULTS.c.used).where(~wanted).order_by(RESULTS.c.used)
            ).all()
        surplus = self._archive.total_bytes() - self._limits.result_bytes
        going = []
        for content, size, used in rows:
            if surplus <= 0 and used >= old:
                break
            going.append(content)
            surplus -= size
        self._archive.drop(going)
