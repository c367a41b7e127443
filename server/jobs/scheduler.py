"""Long work in processes of its own: a queue, lanes that work on it, and what becomes of each piece.

A lane is a thread with something that computes: a worker process, or a place on a cluster. Single runs go first, in
their order; sweeps share what is left, the one with the fewest tasks under way next.
"""

import logging
import threading
import time
from collections import deque
from typing import Any

from vfcore.errors import VocalisError
from vocalis.server.http.problems import problem_of
from vocalis.server.jobs.executor_slot import Cluster, Died, Failed, Finished, Lane
from vocalis.server.jobs.points import PointStore
from vocalis.server.jobs.sweep_task import carry_out
from vocalis.server.jobs.sweep_work import InFlight, SweepWork
from vocalis.server.jobs.work import Listener, Work
from vocalis.server.jobs.worker import Worker

log = logging.getLogger("vocalis")
ATTEMPTS = 2  # a worker may die once under a piece of work
CLOSE_S = 1.0


class Engine:
    """At most ``workers`` processes, which start when there is work for them (``warm`` of them before, see ``warm``);
    and with a ``cluster`` as many tasks of sweeps on it as it has room for.
    """

    def __init__(
        self, workers: int, listener: Listener, points: PointStore, cluster: Cluster | None = None, warm: int = 0
    ):
        self._most, self._cluster, self._warm = workers, cluster, min(warm, workers)
        self._listener, self._points = listener, points
        self._queue: deque[Work] = deque()
        self._running: dict[str, Work] = {}
        self._sweeps: dict[str, SweepWork] = {}
        self._in_flight = InFlight()
        self._out = 0  # tasks of sweeps under way
        self._turn = 0  # goes up when something has changed for sweeps
        self._workers: list[Worker] = []
        self._threads: list[threading.Thread] = []
        self._idle = 0
        self._closing = threading.Event()
        self._changed = threading.Condition()

    def start(self) -> None:
        """Connect to the cluster, where there is one."""
        if self._cluster is not None:
            self._cluster.start()

    def warm(self) -> None:
        """Start processes and have them load their kernels, so that no first map waits for that."""
        with self._changed:
            while len(self._workers) < self._warm and not self._closing.is_set():
                self._open_lane(rehearse=True)

    def submit(self, work: Work) -> None:
        """Put a single run at the end of the queue."""
        with self._changed:
            self._queue.append(work)
            if self._idle < len(self._queue):
                self._open_lane()
            self._changed.notify_all()

    def submit_sweep(self, sweep: SweepWork) -> None:
        """Let a sweep take its share of the workers."""
        with self._changed:
            self._sweeps[sweep.id] = sweep
            if self._cluster is None:
                sweep.portions.workers = self._most
                for _ in range(min(self._most, len(sweep.sweep))):
                    self._open_lane()
            else:
                sweep.portions.workers = self._cluster.capacity
                self._open_cluster_lanes()
            self._turn += 1
            self._changed.notify_all()

    def stop(self, work_id: str) -> None:
        """Take work out of the queue, or stop it within a second (on a cluster: when its present tasks are done)."""
        with self._changed:
            self._queue = deque(work for work in self._queue if work.id != work_id)
            for under_way in (self._running.get(work_id), self._sweeps.pop(work_id, None)):
                if under_way is not None:
                    under_way.stop.set()

    @property
    def name(self) -> str:
        return "processes" if self._cluster is None else "dask"

    @property
    def workers(self) -> int:
        """How many pieces of work can be under way."""
        return self._most if self._cluster is None else self._cluster.capacity

    @property
    def worker_pids(self) -> tuple[int, ...]:
        """Process ids of the workers alive."""
        return tuple(pid for worker in self._workers if (pid := worker.pid) is not None)

    @property
    def busy(self) -> tuple[str, ...]:
        """Ids of the work under way."""
        return (*self._running, *(() if not self._out else self._sweeps))

    @property
    def waiting(self) -> int:
        """How many pieces of work have not begun."""
        return len(self._queue) + sum(not sweep.tasks_out and not sweep.n_done for sweep in self._sweeps.values())

    def close(self) -> None:
        """Stop everything; returns within about a second."""
        with self._changed:
            self._closing.set()
            self._queue.clear()
            for work in (*self._running.values(), *self._sweeps.values()):
                work.stop.set()
            self._changed.notify_all()
        for worker in self._workers:
            worker.close()
        deadline = time.monotonic() + CLOSE_S
        for thread in self._threads:
            thread.join(max(0.0, deadline - time.monotonic()))
        if self._cluster is not None:
            self._cluster.close()

    def _open_lane(self, rehearse: bool = False) -> None:
        if len(self._workers) < self._most:
            self._workers.append(worker := Worker())
            self._start(worker, runs=True, sweeps=self._cluster is None, rehearse=rehearse)

    def _open_cluster_lanes(self) -> None:
        while self._cluster.lanes < min(self._cluster.capacity, self._cluster.most):
            self._start(self._cluster.new_lane(), runs=False, sweeps=True)

    def _start(self, lane: Lane, runs: bool, sweeps: bool, rehearse: bool = False) -> None:
        what = lane, runs, sweeps, rehearse
        self._threads.append(threading.Thread(target=self._serve, args=what, name="lane", daemon=True))
        self._threads[-1].start()

    def _serve(self, lane: Lane, runs: bool, sweeps: bool, rehearse: bool) -> None:
        if rehearse and isinstance(lane.run("rehearsal", None, lambda _: None, self._closing), Failed | Died):
            log.warning("a worker could not rehearse: first runs will take longer")
        while (piece := self._take(runs, sweeps)) is not None:
            if isinstance(piece, Work):
                self._run_single(lane, piece)
            else:
                self._serve_sweep(lane, piece)

    def _take(self, runs: bool, sweeps: bool) -> Work | SweepWork | None:
        with self._changed:
            while not self._closing.is_set():
                if runs and self._queue:
                    work = self._queue.popleft()
                    self._running[work.id] = work
                    return work
                if sweeps and self._has_room() and (sweep := self._next_sweep()) is not None:
                    sweep.tasks_out += 1
                    self._out += 1
                    return sweep
                self._idle += runs
                self._changed.wait()
                self._idle -= runs
            return None

    def _has_room(self) -> bool:
        return self._cluster is None or self._out < self._cluster.capacity

    def _next_sweep(self) -> SweepWork | None:
        asking = [sweep for sweep in self._sweeps.values() if sweep.asked_at != self._turn]
        return min(asking, key=lambda sweep: sweep.tasks_out, default=None)

    # Single runs.

    def _run_single(self, lane: Lane, work: Work) -> None:
        try:
            self._run(lane, work)
        except Exception as error:
            log.exception("work %s failed in the server", work.id)
            lane.close()
            self._listener.failed(work.id, problem_of(error))
        finally:
            with self._changed:
                del self._running[work.id]

    def _run(self, lane: Lane, work: Work) -> None:
        say = self._listener
        while True:
            work.attempts += 1
            say.started(work.id)
            outcome = lane.run(work.kind, work.request, lambda part: say.progressed(work.id, part), work.stop)
            if isinstance(outcome, Died) and work.attempts < ATTEMPTS and not work.stop.is_set():
                say.retried(work.id)
                continue
            if isinstance(outcome, Finished):
                say.finished(work.id, outcome.result)
            elif isinstance(outcome, Failed):
                say.failed(work.id, outcome.problem)
            elif isinstance(outcome, Died) and not work.stop.is_set():
                say.died(work.id, outcome.exit_code)
            return

    # Sweeps.

    def _serve_sweep(self, lane: Lane, sweep: SweepWork) -> None:
        """One task of a sweep, from planning to storing."""
        task, found = None, False
        with self._changed:
            turn, begins = self._turn, not sweep.begun
            sweep.begun = True
        try:
            if begins:
                self._listener.started(sweep.id)
            task = sweep.next_task(self._points, self._listener, self._in_flight)
            found = task is not None
            if task is not None:
                problem = carry_out(lane, task, self._listener)
                if problem is not None:
                    self._fail(sweep, problem)
        except Exception as error:
            if not sweep.stop.is_set():
                if not isinstance(error, VocalisError):
                    log.exception("sweep %s failed in the server", sweep.id)
                self._fail(sweep, problem_of(error))
        finally:
            if task is not None:
                self._in_flight.release(task.addresses)
            with self._changed:
                sweep.tasks_out -= 1
                self._out -= 1
                if found:
                    self._turn += 1
                    if self._cluster is not None:
                        self._open_cluster_lanes()
                else:
                    sweep.asked_at = turn
                complete = sweep.is_complete and self._sweeps.pop(sweep.id, None) is not None
                self._changed.notify_all()
            if complete:
                self._listener.finished(sweep.id, None)

    def _fail(self, sweep: SweepWork, problem: dict[str, Any]) -> None:
        sweep.stop.set()
        with self._changed:
            known = self._sweeps.pop(sweep.id, None)
        if known is not None:
            self._listener.failed(sweep.id, problem)
