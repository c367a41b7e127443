"""A sweep from beginning to end without a server: over processes of this machine, or any executor that is given."""

import os
from collections import deque
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from dataclasses import dataclass

from vfcore.errors import Cancelled
from vfcore.runs.sweep import pool
from vfcore.runs.sweep.cost import Portions
from vfcore.runs.sweep.journal import Journal
from vfcore.runs.sweep.plan import Sweep
from vfcore.runs.sweep.row import failed_row
from vfcore.runs.sweep.table import PENDING, SweepTable
from vfcore.runs.sweep.task import TaskResult, run_task
from vfcore.version import MODEL_VERSION

IN_FLIGHT = 2  # tasks per worker: one computes, one waits beside it
ATTEMPTS = 2  # a worker may die once under a task
ENDED_TWICE = "The worker process ended while it computed this point, twice."
_LISTEN_S = 0.2

Progress = Callable[[int, int, int], None]


@dataclass(slots=True)
class _Task:
    positions: list[int]
    attempts: int = 0


def run_sweep(
    sweep: Sweep,
    workers: int | None = None,
    *,
    journal: Journal | None = None,
    progress: Progress | None = None,
    stop: Callable[[], bool] | None = None,
    executor: Executor | None = None,
) -> SweepTable:
    """Compute every point that ``journal`` does not have yet.

    ``workers``: processes, as many as cores for None; 1 computes in this one. ``executor`` computes instead where it
    is given (``distributed.Client(…).get_executor()``), ``workers`` tasks at a time. ``progress(done, failed, total)``
    is called after every task. A worker that dies is replaced and its task tried once more, point by point; one that
    ends it again carries the reason. Raises Cancelled once ``stop()`` is true; what was computed is in the journal.
    """
    workers = workers or os.cpu_count() or 1
    run = _Run(sweep, workers, journal, progress or (lambda *_: None), stop or (lambda: False))
    if executor is not None:
        run.with_executor(executor)
    elif workers == 1:
        run.here()
    else:
        run.with_processes()
    return run.table


class _Run:
    def __init__(
        self, sweep: Sweep, workers: int, journal: Journal | None, progress: Progress, stop: Callable[[], bool]
    ):
        self._sweep, self._workers, self._journal, self._progress, self._stop = sweep, workers, journal, progress, stop
        self.table = SweepTable(sweep)
        if journal is not None:
            self.table.fill(journal.rows())
        self._todo = deque(int(k) for k in (self.table.state == PENDING).nonzero()[0])
        self._suspects: deque[_Task] = deque()
        self._portions = Portions(sweep, workers)
        self._say()

    def here(self) -> None:
        while (task := self._next()) is not None:
            self._keep(task, run_task(self._sweep.part(task.positions), MODEL_VERSION, self._stop))

    def with_processes(self) -> None:
        while self._todo or self._suspects:
            executor = pool.processes(self._workers)
            try:
                self.with_executor(executor)
            except BrokenExecutor:
                continue
            finally:
                pool.end(executor)

    def with_executor(self, executor: Executor) -> None:
        under_way: dict[Future[TaskResult], _Task] = {}
        try:
            while True:
                self._hand_out(executor, under_way)
                if not under_way:
                    return
                done, _ = wait(under_way, _LISTEN_S, FIRST_COMPLETED)
                if self._stop():
                    raise Cancelled("The sweep was stopped.")
                for future in done:
                    self._keep(under_way[future], future.result())
                    del under_way[future]
        except BrokenExecutor:
            self._suspect(list(under_way.values()))
            raise
        finally:
            for future in under_way:
                future.cancel()

    def _hand_out(self, executor: Executor, under_way: dict[Future[TaskResult], _Task]) -> None:
        """Tasks to the executor; one that a worker died under goes alone, so that it is known which one it was."""
        most = 1 if self._suspects else IN_FLIGHT * self._workers
        if any(task.attempts > 1 for task in under_way.values()):
            return
        while len(under_way) < most and (task := self._next()) is not None:
            try:
                future = executor.submit(run_task, self._sweep.part(task.positions), MODEL_VERSION)
            except BrokenExecutor:
                task.attempts -= 1  # it never began
                self._suspects.append(task)
                raise
            under_way[future] = task
            if task.attempts > 1:
                return

    def _next(self) -> _Task | None:
        if self._suspects:
            task = self._suspects.popleft()
        elif self._todo:
            left = len(self._todo)
            size = min(self._portions.next_size(left), left)
            task = _Task([self._todo.popleft() for _ in range(size)])
        else:
            return None
        task.attempts += 1
        return task

    def _suspect(self, tasks: list[_Task]) -> None:
        for task in tasks:
            if task.attempts < ATTEMPTS:  # point by point, so that only the one that did it is lost
                self._suspects.extend(_Task([position], task.attempts) for position in task.positions)
                continue
            row = failed_row(ENDED_TWICE, len(self.table.columns))
            self.table.fill((position, row) for position in task.positions)  # not to the journal: it was no answer
            self._say()

    def _keep(self, task: _Task, result: TaskResult) -> None:
        if self._journal is not None:
            self._journal.put(task.positions, result.rows)
        self.table.fill(zip(task.positions, result.rows, strict=True))
        self._portions.learn(len(task.positions), result.seconds)
        self._say()

    def _say(self) -> None:
        self._progress(self.table.n_done, self.table.n_failed, len(self._sweep))
