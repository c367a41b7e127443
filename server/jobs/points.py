"""Scalars of sweep points on disk: one row per point, shared by every sweep that contains it."""

import threading
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from sqlalchemy import bindparam, func, select
from sqlalchemy.dialects.sqlite import insert

from vfcore.runs.sweep.row import Row, decode, encode, failed_row
from vocalis.server.jobs.database import Database
from vocalis.server.jobs.model import Job
from vocalis.server.jobs.store import save_jobs
from vocalis.server.jobs.tables import MEMBERS, POINTS

_AT_A_TIME = 500  # addresses in one query
_COMPUTED = insert(POINTS).values(times=1)
_COMPUTED = _COMPUTED.on_conflict_do_update(
    index_elements=["address"],
    set_={"row": _COMPUTED.excluded.row, "state": _COMPUTED.excluded.state, "times": POINTS.c.times + 1},
)
_MEMBER = insert(MEMBERS).on_conflict_do_nothing()
_NUMBER = select(POINTS.c.number).where(POINTS.c.address == bindparam("wanted")).scalar_subquery()
_NEW_MEMBER = insert(MEMBERS).values(number=_NUMBER).on_conflict_do_nothing()


class Done(NamedTuple):
    """Positions of a sweep that are done, and how many of them have no answer."""

    positions: set[int]
    n_failed: int


class InFlight:
    """Addresses of points being computed, of all sweeps: none is computed twice at the same time. Thread-safe."""

    def __init__(self) -> None:
        self._addresses: set[str] = set()
        self._lock = threading.Lock()

    def claim(self, addresses: list[str]) -> list[bool]:
        """Which of these were free and are now taken."""
        with self._lock:
            free = []
            for address in addresses:
                free.append(address not in self._addresses)
                self._addresses.add(address)
            return free

    def release(self, addresses: list[str]) -> None:
        with self._lock:
            self._addresses.difference_update(addresses)


class PointStore:
    """Thread-safe."""

    def __init__(self, database: Database):
        self._database = database
        self.in_flight = InFlight()

    def done(self, work_id: str) -> Done:
        """Which points of a sweep are stored."""
        with self._database.read() as connection:
            rows = connection.execute(
                select(MEMBERS.c.position, func.coalesce(POINTS.c.state, ""))
                .select_from(MEMBERS.outerjoin(POINTS, POINTS.c.number == MEMBERS.c.number))
                .where(MEMBERS.c.work_id == work_id)
            ).all()
        return Done({position for position, _ in rows}, sum(not state for _, state in rows))

    def known(self, addresses: Sequence[str]) -> dict[str, tuple[int, bool]]:
        """Of these addresses the stored ones: number of the row, and whether it has no answer."""
        found: dict[str, tuple[int, bool]] = {}
        with self._database.read() as connection:
            for first in range(0, len(addresses), _AT_A_TIME):
                keys = [bytes.fromhex(address) for address in addresses[first : first + _AT_A_TIME]]
                rows = connection.execute(
                    select(POINTS.c.address, POINTS.c.number, POINTS.c.state).where(POINTS.c.address.in_(keys))
                )
                found |= {row.address.hex(): (row.number, row.state is None) for row in rows}
        return found

    def link(self, work_id: str, numbers: Mapping[int, int], jobs: Iterable[Job]) -> None:
        """Make stored points members of a sweep at these positions; ``jobs`` are saved with them."""
        with self._database.write() as connection:
            if numbers:
                members = [
                    {"work_id": work_id, "position": position, "number": number, "problem": None}
                    for position, number in numbers.items()
                ]
                connection.execute(_MEMBER, members)
            save_jobs(connection, list(jobs))

    def put(
        self, work_id: str, positions: Sequence[int], addresses: Sequence[str], rows: Sequence[Row], jobs: Iterable[Job]
    ) -> None:
        """Store computed points of a sweep; ``jobs`` are saved with them, in one transaction."""
        keys = [bytes.fromhex(address) for address in addresses]
        with self._database.write() as connection:
            connection.execute(
                _COMPUTED,
                [{"address": key, "state": row.state, "row": encode(row)} for key, row in zip(keys, rows, strict=True)],
            )
            connection.execute(
                _NEW_MEMBER,
                [
                    {"work_id": work_id, "position": position, "problem": None, "wanted": key}
                    for position, key in zip(positions, keys, strict=True)
                ],
            )
            save_jobs(connection, list(jobs))

    def give_up(self, work_id: str, positions: Sequence[int], problem: str, jobs: Iterable[Job]) -> None:
        """Store why points of a sweep will not be computed; no other sweep sees this."""
        with self._database.write() as connection:
            connection.execute(
                _MEMBER,
                [
                    {"work_id": work_id, "position": position, "number": None, "problem": problem}
                    for position in positions
                ],
            )
            save_jobs(connection, list(jobs))

    def rows(self, work_id: str, width: int) -> Iterator[tuple[int, Row]]:
        """The stored points of a sweep with their positions; ``width`` columns each."""
        wanted = (
            select(MEMBERS.c.position, POINTS.c.row, MEMBERS.c.problem)
            .select_from(MEMBERS.outerjoin(POINTS, POINTS.c.number == MEMBERS.c.number))
            .where(MEMBERS.c.work_id == work_id)
        )
        with self._database.read() as connection:
            for position, row, problem in connection.execute(wanted.execution_options(yield_per=1000)):
                yield position, failed_row(problem or "", width) if row is None else decode(row)

    def recomputed(self) -> int:
        """How many stored points were computed more than once."""
        with self._database.read() as connection:
            return connection.execute(select(func.count()).where(POINTS.c.times > 1)).scalar_one()
