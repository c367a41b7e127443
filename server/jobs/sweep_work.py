"""A sweep under way: which of its points are done, and what the next task is."""

import threading
from collections import deque
from typing import Any, Protocol

from vfcore.runs.sweep.cost import Portions
from vfcore.runs.sweep.document import sweep_from_dict
from vfcore.runs.sweep.plan import Sweep
from vfcore.runs.sweep.row import Row
from vocalis.server.jobs.points import PointStore

LOOK_AHEAD = 2000  # points looked up at a time when they turn out to be stored already


class Task:
    """Points of a sweep that one worker computes in one go."""

    def __init__(self, work: "SweepWork", positions: list[int], addresses: list[str]):
        self.work, self.positions, self.addresses = work, positions, addresses

    def singles(self) -> "list[Task]":
        """The same points, one task each."""
        return [
            Task(self.work, [position], [key]) for position, key in zip(self.positions, self.addresses, strict=True)
        ]

    @property
    def part(self) -> Sweep:
        """What the worker is sent."""
        return self.work.sweep.part(self.positions)


class Keeper(Protocol):
    """Who stores what a sweep has got; called from the engine's threads."""

    def linked(self, work: "SweepWork", numbers: dict[int, int]) -> None: ...
    def computed(self, task: Task, rows: list[Row]) -> None: ...
    def gave_up(self, task: Task, problem: str) -> None: ...


class InFlight:
    """Addresses of points being computed, of all sweeps: none is computed twice at a time. Thread-safe."""

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


class SweepWork:
    """``next_task`` is called by one engine thread at a time, ``account`` by any."""

    kind = "sweep"

    def __init__(self, work_id: str, request: dict[str, Any], fresh: bool = False):
        self.id, self.fresh = work_id, fresh
        self.sweep = sweep_from_dict(request)
        self.stop = threading.Event()
        self.begun = False
        self.tasks_out = 0
        self.asked_at = -1
        self.n_done = self.n_failed = 0
        self.portions = Portions(self.sweep, 1)
        self._todo: deque[int] | None = None
        self._planning = threading.Lock()
        self._counting = threading.Lock()

    @property
    def is_complete(self) -> bool:
        return self.n_done == len(self.sweep)

    def account(self, done: int, failed: int) -> None:
        """So many more points are stored, so many of them without an answer."""
        with self._counting:
            self.n_done += done
            self.n_failed += failed

    def next_task(self, points: PointStore, keeper: Keeper, in_flight: InFlight) -> Task | None:
        """Points to compute now; None while all that are left are under way. Stored ones are linked on the way."""
        with self._planning:
            if self._todo is None:
                self._resume(points)
            size, look = self.portions.next_size(len(self._todo)), 0
            positions: list[int] = []
            addresses: list[str] = []
            waiting: list[int] = []
            while self._todo and len(positions) < size and not self.stop.is_set():
                look = min(max(size, 2 * look), LOOK_AHEAD)  # a long stored stretch is passed in large steps
                batch = [self._todo.popleft() for _ in range(min(look, len(self._todo)))]
                asked = [self.sweep.address(position) for position in batch]
                stored = {} if self.fresh else points.known(asked)
                links = {position: stored[key] for position, key in zip(batch, asked, strict=True) if key in stored}
                if links:
                    self.account(len(links), sum(failed for _, failed in links.values()))
                    keeper.linked(self, {position: number for position, (number, _) in links.items()})
                left = [(p, key) for p, key in zip(batch, asked, strict=True) if p not in links]
                room = size - len(positions)
                self._todo.extendleft(position for position, _ in reversed(left[room:]))
                left = left[:room]
                for (position, key), free in zip(left, in_flight.claim([key for _, key in left]), strict=True):
                    if free:
                        positions.append(position)
                        addresses.append(key)
                    else:
                        waiting.append(position)
            self._todo.extend(waiting)
            return Task(self, positions, addresses) if positions else None

    def _resume(self, points: PointStore) -> None:
        done = points.done(self.id)
        self.account(len(done.positions), done.n_failed)
        self._todo = deque(position for position in range(len(self.sweep)) if position not in done.positions)
