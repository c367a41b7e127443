"""One worker process, as the server sees it: started when it is needed, replaced when it has died."""

import multiprocessing
import threading
import time
from typing import Any

from vocalis.server.jobs.executor_slot import Call, Died, Failed, Finished, Outcome, Progress, Stopped
from vocalis.server.jobs.runner import read_result, serve_work

_SPAWN = multiprocessing.get_context("spawn")  # a fork would copy threads' locks in whatever state they are
POLL_S = 0.05
STOP_WITHIN_S = 0.7  # to stop between chunks; then the process is ended


class Worker:
    """Used by one thread at a time, except ``close``."""

    def __init__(self) -> None:
        self._process: multiprocessing.process.BaseProcess | None = None
        self._pipe: Any = None

    @property
    def pid(self) -> int | None:
        """Process id; None when there is no process."""
        return self._process.pid if self._process else None

    def run(self, call: Call, progress: Progress, stop: threading.Event) -> Outcome:
        """Compute a call; returns when it is finished, failed, stopped, or the process died."""
        deadline = None
        try:
            self._ensure()
            self._pipe.send(("run", call.function, call.arguments))
            while True:
                if deadline is None and stop.is_set():
                    self._pipe.send(("stop",))
                    deadline = time.monotonic() + STOP_WITHIN_S
                if deadline is not None and time.monotonic() > deadline:
                    self.close()
                    return Stopped()
                if not self._pipe.poll(POLL_S):
                    continue
                message, *rest = self._pipe.recv()
                if message == "progress":
                    progress(*rest)
                elif message == "result":
                    return Finished(read_result(self._pipe, *rest))
                elif message == "problem":
                    return Failed(*rest)
                elif message == "stopped":
                    return Stopped()
        except (EOFError, OSError):
            exit_code = self._reap()
            return Stopped() if stop.is_set() else Died(exit_code)

    def close(self) -> None:
        """End the process now."""
        if self._process is not None:
            self._process.kill()
            self._reap()

    def _ensure(self) -> None:
        if self._process is not None and self._process.is_alive():
            return
        self.close()
        self._pipe, other_end = _SPAWN.Pipe()
        process = _SPAWN.Process(target=serve_work, args=(other_end,), name="vocalis-worker", daemon=True)
        process.start()
        self._process = process
        other_end.close()

    def _reap(self) -> int | None:
        process, self._process = self._process, None
        if process is None:  # it could not be started, or another thread was here first
            return None
        process.join(1.0)
        if process.is_alive():
            process.kill()
            process.join(1.0)
        self._pipe.close()
        return process.exitcode
