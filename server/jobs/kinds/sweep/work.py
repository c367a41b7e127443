"""A sweep under way: which of its points are done, what the next task is, and what its tasks give."""

import threading
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING

from vfcore.runs.result import SimulationResult
from vfcore.runs.sweep.cost import Portions
from vfcore.runs.sweep.plan import Sweep
from vfcore.runs.sweep.row import Row, columns, failed_row
from vocalis.server.jobs.archive import Archive
from vocalis.server.jobs.kinds.sweep.point_event import MOST_IN_EVENTS, point_document
from vocalis.server.jobs.kinds.sweep.task import SweepTask
from vocalis.server.jobs.model import Job
from vocalis.server.jobs.work import Work, WorkListener

if TYPE_CHECKING:
    from vocalis.server.jobs.storage import Storage

LOOK_AHEAD = 2000  # most points looked up at a time while they turn out to be stored already


def is_kept(sweep: Sweep, position: int, has_no_answer: bool, results: Archive) -> bool:
    """Whether a point with a stored row needs no run: a sweep that keeps waveforms also needs the whole result."""
    return not sweep.keep_waveforms or has_no_answer or results.is_stored(sweep.computation(position).address())


class SweepWork(Work):
    """``next_task`` is called by one thread of the scheduler at a time, the rest by any.

    ``fresh``: compute again what is stored already.
    """

    is_shared = True

    def __init__(
        self, work_id: str, sweep: Sweep, storage: "Storage", listener: WorkListener, fresh: bool = False
    ):  # fmt: skip
        super().__init__(work_id, listener)
        self.sweep, self.fresh = sweep, fresh
        self.n_done = self.n_failed = 0
        self.portions = Portions(sweep, 1)
        self._points, self._results = storage.points, storage.results
        self._todo: deque[int] | None = None  # positions; None before the first task
        self._planning = threading.Lock()

    @property
    def most_tasks(self) -> int:
        return len(self.sweep)

    @property
    def is_complete(self) -> bool:
        return self.n_done == len(self.sweep)

    def finish(self) -> None:
        self.listener.finished(self.id)

    def next_task(self) -> SweepTask | None:
        """Points to compute now; None while all that are left are under way. Stored ones are linked on the way."""
        with self._planning:
            todo = self._begun() if self._todo is None else self._todo
            self.portions.workers = self.workers
            size, look = self.portions.next_size(len(todo)), 0
            positions: list[int] = []
            addresses: list[str] = []
            waiting: list[int] = []
            while todo and len(positions) < size and not self.stop.is_set():
                look = min(max(size, 2 * look), LOOK_AHEAD)  # growing steps pass quickly over many stored points
                batch = [todo.popleft() for _ in range(min(look, len(todo)))]
                keys = [self.sweep.address(position) for position in batch]
                stored = {} if self.fresh else self._points.known(keys)
                found = {
                    position: stored[key]
                    for position, key in zip(batch, keys, strict=True)
                    if key in stored and is_kept(self.sweep, position, stored[key][1], self._results)
                }
                if found:
                    self._link(found)
                left = [(p, key) for p, key in zip(batch, keys, strict=True) if p not in found]
                room = size - len(positions)
                todo.extendleft(position for position, _ in reversed(left[room:]))
                left = left[:room]
                free = self._points.in_flight.claim([key for _, key in left])
                for (position, key), is_free in zip(left, free, strict=True):
                    if is_free:
                        positions.append(position)
                        addresses.append(key)
                    else:
                        waiting.append(position)
            todo.extend(waiting)
            return SweepTask(self, positions, addresses) if positions else None

    def computed(self, task: SweepTask, rows: list[Row]) -> None:
        """A task is done: its points are stored before any client gets them."""

        def store(jobs: list[Job]) -> None:
            self._points.put(self.id, task.positions, task.addresses, rows, jobs)

        self._account(len(rows), sum(row.state is None for row in rows), store)
        self._publish(task.positions, rows)

    def gave_up(self, task: SweepTask, problem: str) -> None:
        """A task has no answer, and is not tried again."""
        size = len(task.positions)
        self._account(size, size, lambda jobs: self._points.give_up(self.id, task.positions, problem, jobs))
        self._publish(task.positions, [failed_row(problem, len(columns(self.sweep)))] * size)

    def keep_results(self, task: SweepTask, results: dict[int, SimulationResult]) -> None:
        """Store whole results of points, by their place in the task, at the address of the same single run."""
        for place, result in results.items():
            self._results.store(self.sweep.computation(task.positions[place]).address(), result)

    def close_task(self, task: SweepTask) -> None:
        """Other sweeps may compute the points of a task again."""
        self._points.in_flight.release(task.addresses)

    def _begun(self) -> deque[int]:
        """Continue from what is stored; the positions that are left."""
        self.listener.started(self.id)
        done = self._points.done(self.id)
        self.n_done, self.n_failed = len(done.positions), done.n_failed
        self._todo = deque(position for position in range(len(self.sweep)) if position not in done.positions)
        return self._todo

    def _link(self, found: dict[int, tuple[int, bool]]) -> None:
        """These points turned out to be stored: by position the number of the row, and whether it has no answer."""
        numbers = {position: number for position, (number, _) in found.items()}
        n_failed = sum(failed for _, failed in found.values())
        self._account(len(found), n_failed, lambda jobs: self._points.link(self.id, numbers, jobs))
        rows: list[Row] | None = None
        if len(self.sweep) <= MOST_IN_EVENTS:
            stored = dict(self._points.rows(self.id, len(columns(self.sweep))))
            rows = [stored[position] for position in numbers]
        self._publish(list(numbers), rows)

    def _account(self, n_done: int, n_failed: int, store: Callable[[list[Job]], None]) -> None:
        """Count points as done, and store them with the new counts of the jobs; all of it or nothing."""
        with self.listener.lock:
            before = self.n_done, self.n_failed
            self.n_done, self.n_failed = self.n_done + n_done, self.n_failed + n_failed
            try:
                store(self.listener.count(self.id, self.n_done, self.n_failed))
            except BaseException:
                self.n_done, self.n_failed = before
                self.listener.count(self.id, *before)
                raise

    def _publish(self, positions: list[int], rows: list[Row] | None) -> None:
        self.listener.publish_part(self.id, lambda job_id: point_document(job_id, self.sweep, positions, rows))
