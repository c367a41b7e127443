"""Long work in other processes: the work that waits, and the executor slots that compute its tasks.

A slot is a worker process or a place on a cluster, served by a thread of its own. Work that is not shared goes first,
in the order of its submission. Shared work gets what is left: the next task comes from the work with the fewest tasks
under way.
"""

import logging
import threading
import time
from collections import deque
from typing import Any

from vfcore.errors import VocalisError
from vocalis.server.jobs.computations import warm_up
from vocalis.server.jobs.executor_slot import Call, Cluster, Died, ExecutorSlot, Failed
from vocalis.server.jobs.work import Task, Work, WorkListener
from vocalis.server.jobs.worker import Worker
from vocalis.server.problems import problem_of

log = logging.getLogger("vocalis")
CLOSE_S = 1.0


class Scheduler:
    """At most ``workers`` processes, started when there is work for them (``warm`` of them before, see ``warm_up``);
    with a ``cluster`` shared work runs on that, in as many tasks as it has room for.
    """

    def __init__(self, workers: int, listener: WorkListener, cluster: Cluster | None = None, warm: int = 0):
        self._most, self._cluster, self._warm = workers, cluster, min(warm, workers)
        self._listener = listener
        self._work: dict[str, Work] = {}  # neither complete, failed nor stopped
        self._queue: deque[Work] = deque()  # of these, what is not shared and has not begun
        self._under_way: list[Work] = []  # once for every task
        self._turn = 0  # goes up when shared work may have new tasks
        self._workers: list[Worker] = []
        self._threads: list[threading.Thread] = []
        self._idle = 0
        self._closing = threading.Event()
        self._changed = threading.Condition()

    def start(self) -> None:
        """Connect to the cluster, if there is one."""
        if self._cluster is not None:
            self._cluster.start()

    def warm_up(self) -> None:
        """Start processes and load their kernels, so that no first map waits for that."""
        with self._changed:
            while len(self._workers) < self._warm and not self._closing.is_set():
                self._open_worker(warm=True)

    def submit(self, work: Work) -> None:
        """Take work; it begins when a slot is free."""
        with self._changed:
            self._work[work.id] = work
            if not work.is_shared:
                self._queue.append(work)
                if self._idle < len(self._queue):
                    self._open_worker()
            elif self._cluster is None:
                work.workers = self._most
                for _ in range(min(self._most, work.most_tasks)):
                    self._open_worker()
            else:
                work.workers = self._cluster.capacity
                self._open_cluster_slots(self._cluster)
            self._turn += 1
            self._changed.notify_all()

    def stop(self, work_id: str) -> None:
        """Take work out of the queue, or stop it within a second (on a cluster: when its present tasks are done)."""
        with self._changed:
            self._queue = deque(work for work in self._queue if work.id != work_id)
            if (work := self._work.pop(work_id, None)) is not None:
                work.stop.set()

    @property
    def name(self) -> str:
        """How tasks of shared work are computed."""
        return "processes" if self._cluster is None else "dask"

    @property
    def workers(self) -> int:
        """How many tasks can be under way."""
        return self._most if self._cluster is None else self._cluster.capacity

    @property
    def worker_pids(self) -> tuple[int, ...]:
        """Process ids of the workers alive."""
        return tuple(pid for worker in self._workers if (pid := worker.pid) is not None)

    @property
    def busy(self) -> tuple[str, ...]:
        """Ids of the work under way."""
        with self._changed:
            return tuple(dict.fromkeys(work.id for work in self._under_way))

    @property
    def waiting(self) -> int:
        """How many pieces of work have not begun."""
        with self._changed:
            return sum(not work.begun for work in self._work.values())

    def close(self) -> None:
        """Stop everything; returns within about a second."""
        with self._changed:
            self._closing.set()
            self._queue.clear()
            for work in (*self._work.values(), *self._under_way):
                work.stop.set()
            self._changed.notify_all()
        for worker in self._workers:
            worker.close()
        deadline = time.monotonic() + CLOSE_S
        for thread in self._threads:
            thread.join(max(0.0, deadline - time.monotonic()))
        if self._cluster is not None:
            self._cluster.close()

    def _open_worker(self, warm: bool = False) -> None:
        if len(self._workers) < self._most:
            self._workers.append(worker := Worker())
            self._serve_in_thread(worker, True, self._cluster is None, warm)

    def _open_cluster_slots(self, cluster: Cluster) -> None:
        while cluster.slots < min(cluster.capacity, cluster.most):
            self._serve_in_thread(cluster.new_slot(), False, True, False)

    def _serve_in_thread(self, slot: ExecutorSlot, single: bool, shared: bool, warm: bool) -> None:
        arguments = slot, single, shared, warm
        self._threads.append(threading.Thread(target=self._serve, args=arguments, name="slot", daemon=True))
        self._threads[-1].start()

    def _serve(self, slot: ExecutorSlot, single: bool, shared: bool, warm: bool) -> None:
        """Main function of a slot's thread; ``single`` and ``shared``: which work it takes."""
        if warm and isinstance(slot.run(Call(warm_up), lambda _: None, self._closing), Failed | Died):
            log.warning("a worker could not warm up: first runs will take longer")
        while (work := self._take(single, shared)) is not None:
            self._serve_task(slot, work)

    def _take(self, single: bool, shared: bool) -> Work | None:
        with self._changed:
            while not self._closing.is_set():
                work = self._queue.popleft() if single and self._queue else None
                if work is None and shared and self._has_room():
                    work = self._next_shared()
                if work is not None:
                    work.begun = True
                    work.tasks_out += 1
                    self._under_way.append(work)
                    return work
                self._idle += single
                self._changed.wait()
                self._idle -= single
            return None

    def _has_room(self) -> bool:
        return self._cluster is None or sum(work.is_shared for work in self._under_way) < self._cluster.capacity

    def _next_shared(self) -> Work | None:
        ready = [work for work in self._work.values() if work.is_shared and work.asked_at != self._turn]
        return min(ready, key=lambda work: work.tasks_out, default=None)

    def _serve_task(self, slot: ExecutorSlot, work: Work) -> None:
        """One task, from planning to recording."""
        task: Task | None = None
        with self._changed:
            turn = self._turn
        try:
            task = work.next_task()
            if task is not None and (problem := task.run(slot)) is not None:
                self._fail(work, problem)
        except Exception as error:
            if not isinstance(error, VocalisError):
                log.exception("work %s failed in the server", work.id)
                slot.close()  # what is still in its pipe belongs to this task
            self._fail(work, problem_of(error))
        finally:
            if task is not None:
                task.close()
        with self._changed:
            complete = work.is_complete and self._work.pop(work.id, None) is not None
        if complete:
            self._finish(work)
        with self._changed:
            work.tasks_out -= 1
            self._under_way.remove(work)
            if task is None:
                work.asked_at = turn
            else:
                self._turn += 1
                if self._cluster is not None and work.is_shared:
                    self._open_cluster_slots(self._cluster)
            self._changed.notify_all()

    def _finish(self, work: Work) -> None:
        try:
            work.finish()
        except Exception as error:
            log.exception("the answer of work %s could not be stored", work.id)
            self._listener.failed(work.id, problem_of(error))

    def _fail(self, work: Work, problem: dict[str, Any]) -> None:
        """End work with a problem, unless it is over already."""
        with self._changed:
            known = self._work.pop(work.id, None)
        if known is not None:
            work.stop.set()
            self._listener.failed(work.id, problem)
