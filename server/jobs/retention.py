"""What is kept, and for how long: by age, by number and by size, and never at the cost of work under way."""

import threading
import time
from datetime import UTC, datetime, timedelta
from typing import NamedTuple

from sqlalchemy import delete, exists, func, select
from sqlalchemy.dialects.sqlite import insert

from vocalis.server.jobs.archive import ENDING, Archive
from vocalis.server.jobs.database import Database, StorageFull
from vocalis.server.jobs.folder import Folder
from vocalis.server.jobs.model import ACTIVE
from vocalis.server.jobs.tables import JOBS, KEYS, MEMBERS, POINTS, RESULTS

EVERY_S = 60.0


class Limits(NamedTuple):
    """``jobs`` finished ones; ``days`` for jobs and for results nobody asked for; ``points`` rows."""

    jobs: int
    days: float
    result_bytes: int
    points: int


class Retention:
    """Tidies in a thread of its own: when it is started, and every minute."""

    def __init__(self, database: Database, archive: Archive, folder: Folder, limits: Limits):
        self._database, self._archive, self._folder, self._limits = database, archive, folder, limits
        self._end = threading.Event()

    def start(self) -> None:
        threading.Thread(target=self._serve, name="retention", daemon=True).start()

    def close(self) -> None:
        self._end.set()

    def tidy(self) -> None:
        """Forget what is beyond the limits."""
        self._forget_jobs()
        self._forget_points()
        self._forget_results()

    def adopt(self) -> None:
        """Results written just before a server ended get their rows, and what it had only begun to write goes."""
        with self._database.read() as connection:
            known = set(connection.scalars(select(RESULTS.c.content)))
        for path in self._folder.results.iterdir():
            if path.is_dir():  # of vfcore.io.atomic
                for draft in path.iterdir():
                    draft.unlink()
                path.rmdir()
            elif path.suffix == ENDING and path.stem not in known:
                with self._database.write() as connection:
                    connection.execute(
                        insert(RESULTS).values(content=path.stem, bytes=path.stat().st_size, used=time.time())
                    )

    def _serve(self) -> None:
        while not self._end.wait(EVERY_S):
            try:
                self.tidy()
            except StorageFull:  # forgetting needs a little room itself; whoever asks for more is told
                continue

    def _forget_jobs(self) -> None:
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

    def _forget_points(self) -> None:
        """The oldest points that no sweep of a kept job has."""
        with self._database.write() as connection:
            surplus = connection.scalar(select(func.count()).select_from(POINTS)) - self._limits.points
            if surplus > 0:
                unused = ~exists().where(MEMBERS.c.number == POINTS.c.number)
                oldest = select(POINTS.c.number).where(unused).order_by(POINTS.c.number).limit(surplus)
                connection.execute(delete(POINTS).where(POINTS.c.number.in_(oldest)))

    def _forget_results(self) -> None:
        """The least recently used ones, but for those a job under way will give."""
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
