"""Long work in processes of its own: a queue, one thread per worker process, and what becomes of each piece."""

import logging
import threading
import time
from collections import deque
from dataclasses import dataclass, field
from typing import Any, Protocol

from vocalis_server.jobs.worker import Died, Failed, Finished, Worker
from vocalis_server.problems import problem_of

log = logging.getLogger("vocalis")
ATTEMPTS = 2  # a worker may die once under a piece of work
CLOSE_S = 1.0


@dataclass(slots=True)
class Work:
    """One computation, however many jobs wait for it."""

    id: str
    kind: str
    request: dict[str, Any]
    attempts: int = 0
    stop: threading.Event = field(default_factory=threading.Event)


class Listener(Protocol):
    """Who is told what becomes of work; called from the engine's threads."""

    def started(self, work_id: str) -> None: ...
    def progressed(self, work_id: str, fraction: float) -> None: ...
    def retried(self, work_id: str) -> None: ...
    def finished(self, work_id: str, result: Any) -> None: ...
    def failed(self, work_id: str, problem: dict[str, Any]) -> None: ...
    def died(self, work_id: str, exit_code: int | None) -> None: ...


class Engine:
    """At most ``workers`` processes. The first one starts with the first piece of work."""

    def __init__(self, workers: int, listener: Listener):
        self._most = workers
        self._listener = listener
        self._queue: deque[Work] = deque()
        self._running: dict[str, Work] = {}
        self._workers: list[Worker] = []
        self._threads: list[threading.Thread] = []
        self._idle = 0
        self._closing = False
        self._changed = threading.Condition()

    def submit(self, work: Work) -> None:
        """Put work at the end of the queue."""
        with self._changed:
            self._queue.append(work)
            if self._idle < len(self._queue) and len(self._workers) < self._most:
                self._workers.append(worker := Worker())
                self._threads.append(threading.Thread(target=self._serve, args=(worker,), name="worker", daemon=True))
                self._threads[-1].start()
            self._changed.notify()

    def stop(self, work_id: str) -> None:
        """Take work out of the queue, or stop it within a second."""
        with self._changed:
            self._queue = deque(work for work in self._queue if work.id != work_id)
            if (work := self._running.get(work_id)) is not None:
                work.stop.set()

    @property
    def worker_pids(self) -> tuple[int, ...]:
        """Process ids of the workers alive."""
        return tuple(worker.pid for worker in self._workers if worker.pid is not None)

    @property
    def busy(self) -> tuple[str, ...]:
        """Ids of the work under way."""
        return tuple(self._running)

    @property
    def waiting(self) -> int:
        """How many pieces of work are in the queue."""
        return len(self._queue)

    def close(self) -> None:
        """Stop everything; returns within about a second."""
        with self._changed:
            self._closing = True
            self._queue.clear()
            for work in self._running.values():
                work.stop.set()
            self._changed.notify_all()
        for worker in self._workers:
            worker.close()
        deadline = time.monotonic() + CLOSE_S
        for thread in self._threads:
            thread.join(max(0.0, deadline - time.monotonic()))

    def _serve(self, worker: Worker) -> None:
        while (work := self._take()) is not None:
            try:
                self._run(worker, work)
            except Exception as error:
                log.exception("work %s failed in the server", work.id)
                worker.close()
                self._listener.failed(work.id, problem_of(error))
            finally:
                with self._changed:
                    del self._running[work.id]

    def _take(self) -> Work | None:
        with self._changed:
            self._idle += 1
            self._changed.wait_for(lambda: self._queue or self._closing)
            self._idle -= 1
            if self._closing:
                return None
            work = self._queue.popleft()
            self._running[work.id] = work
            return work

    def _run(self, worker: Worker, work: Work) -> None:
        say = self._listener
        while True:
            work.attempts += 1
            say.started(work.id)
            outcome = worker.run(work.kind, work.request, lambda part: say.progressed(work.id, part), work.stop)
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
