"""Tasks of shared work on a Dask cluster; the server knows only the address of the Dask scheduler.

A task is one call of 0.2 to 2 s, named by the content of its points, so that the loss of a worker costs little.
``Client.cancel`` does not stop a running call; after it no further tasks are submitted.
"""

import logging
import threading
from typing import Any

from vfcore.errors import Cancelled
from vfcore.runs.sweep.task import WrongModel
from vfcore.spec.address import content_hash
from vocalis.server.jobs.executor_slot import Call, Died, Failed, Finished, NoConnection, Outcome, Progress, Stopped
from vocalis.server.problems import problem_of

log = logging.getLogger("vocalis")
POLL_S = 0.1
CONNECT_S = 5.0
CHECK_EVERY_S = 1.0
PER_THREAD = 2  # tasks in flight for every thread of the cluster: one is computed, one waits


class DaskCluster:
    """``most`` bounds the tasks in flight. Connects once started, and again whenever the connection was lost."""

    def __init__(self, address: str, most: int):
        self.address, self.most = address, most
        self.slots = 0
        self._client: Any = None
        self._threads = 0
        self._lock = threading.Lock()
        self._end = threading.Event()

    def start(self) -> None:
        """Connect, and watch how many workers there are."""
        threading.Thread(target=self._watch, name="cluster", daemon=True).start()

    @property
    def capacity(self) -> int:
        """How many tasks the cluster has room for, running and waiting; 1 while it cannot be reached."""
        return max(1, min(PER_THREAD * self._threads, self.most))

    def _watch(self) -> None:
        reached = True
        while not self._end.is_set():
            try:
                self._threads = sum(self.client().nthreads().values())
                reached = True
            except (NoConnection, OSError, TimeoutError) as error:
                if reached:  # logged once
                    log.warning("%s", error)
                reached, self._threads = False, 0
            self._end.wait(CHECK_EVERY_S)

    def client(self) -> Any:
        """The connection; NoConnection."""
        from distributed import Client

        with self._lock:
            if self._client is None or self._client.status not in ("running", "connecting"):
                try:
                    self._client = Client(self.address, timeout=CONNECT_S, set_as_default=False, name="vocalis")
                except (OSError, TimeoutError) as error:
                    self._client = None
                    raise NoConnection(f"The Dask scheduler at {self.address} cannot be reached: {error}") from error
            return self._client

    def new_slot(self) -> "DaskSlot":
        self.slots += 1
        return DaskSlot(self)

    def close(self) -> None:
        self._end.set()
        with self._lock:
            if self._client is not None:
                self._client.close(timeout=1)
                self._client = None


class DaskSlot:
    """One task on the cluster at a time."""

    def __init__(self, cluster: DaskCluster):
        self._cluster = cluster

    def run(self, call: Call, progress: Progress, stop: threading.Event) -> Outcome:
        """Compute a call, without progress; NoConnection when the scheduler is lost."""
        key = f"vocalis-{content_hash(list(call.addresses))}"
        client, done = self._cluster.client(), threading.Event()
        try:
            future = client.submit(call.function, *call.arguments, key=key, pure=False, retries=0)
            future.add_done_callback(lambda _: done.set())
            while not done.wait(POLL_S):
                if stop.is_set():
                    future.cancel()
                    return Stopped()
                if client.status not in ("running", "connecting"):
                    raise NoConnection(f"The Dask scheduler at {self._cluster.address} was lost.")
            return _outcome(future)
        except (OSError, TimeoutError) as error:
            raise NoConnection(str(error)) from error

    def close(self) -> None:
        """Nothing is computed in this process."""


def _outcome(future: Any) -> Outcome:
    from distributed import KilledWorker

    if future.status == "finished":
        return Finished(future.result())
    if future.status != "error":
        raise NoConnection("The Dask scheduler dropped a task.")
    error = future.exception()
    if isinstance(error, KilledWorker):
        return Died(None)
    if isinstance(error, Cancelled):
        return Stopped()
    if isinstance(error, ImportError | AttributeError):  # before the call could compare versions: other code
        error = WrongModel(f"A worker cannot load this version of Vocalis ({error}); install the same on both.")
    return Failed(problem_of(error))
