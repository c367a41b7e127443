"""Running a sweep without a server, on processes of this machine or on any executor."""

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

IN_FLIGHT = 2  # tasks per worker: one runs, one is queued
ATTEMPTS = 2  # a task may lose one worker
ENDED_TWICE = "The worker process ended while it computed this point, twice."
_POLL_S = 0.2

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

    ``workers``: number of processes; None: one per core; 1: this process. ``executor``: used instead of processes
    (``distributed.Client(…).get_executor()``), with ``workers`` tasks at a time. ``progress(done, failed, total)`` is
    called after every task. If a worker dies, it is replaced and its task is retried point by point; a point that kills
    a second worker fails with that reason. Raises Cancelled once ``stop()`` is true; the journal holds what was
    computed.
    """
    workers = workers or os.cpu_count() or 1
    run = _Run(sweep, workers, journal, progress or (lambda *_: None), stop or (lambda: False))
    if executor is not None:
        run.with_executor(executor)
    elif workers == 1:
        run.in_this_process()
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
        self._report()

    def in_this_process(self) -> None:
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
        running: dict[Future[TaskResult], _Task] = {}
        try:
            while True:
                self._submit(executor, running)
                if not running:
                    return
                done, _ = wait(running, _POLL_S, FIRST_COMPLETED)
                if self._stop():
                    raise Cancelled("The sweep was stopped.")
                for future in done:
                    self._keep(running[future], future.result())
                    del running[future]
        except BrokenExecutor:
            self._suspect(list(running.values()))
            raise
        finally:
            for future in running:
                future.cancel()

    def _submit(self, executor: Executor, running: dict[Future[TaskResult], _Task]) -> None:
        """Submit tasks. A task that lost a worker is submitted alone, so that a second loss can be attributed to it."""
        most = 1 if self._suspects else IN_FLIGHT * self._workers
        if any(task.attempts > 1 for task in running.values()):
            return
        while len(running) < most and (task := self._next()) is not None:
            try:
                future = executor.submit(run_task, self._sweep.part(task.positions), MODEL_VERSION)
            except BrokenExecutor:
                task.attempts -= 1  # it never started
                self._suspects.append(task)
                raise
            running[future] = task
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
            if task.attempts < ATTEMPTS:  # point by point, so that only the point at fault is lost
                self._suspects.extend(_Task([position], task.attempts) for position in task.positions)
                continue
            row = failed_row(ENDED_TWICE, len(self.table.columns))
            # Not in the journal, so that a later run tries these points again.
            self.table.fill((position, row) for position in task.positions)
            self._report()

    def _keep(self, task: _Task, result: TaskResult) -> None:
        if self._journal is not None:
            self._journal.put(task.positions, result.rows)
        self.table.fill(zip(task.positions, result.rows, strict=True))
        self._portions.learn(len(task.positions), result.seconds)
        self._report()

    def _report(self) -> None:
        self._progress(self.table.n_done, self.table.n_failed, len(self._sweep))
