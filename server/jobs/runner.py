"""The worker process: takes one call after the other from a pipe, and answers on it.

In:  ("run", function, arguments) · ("stop",)
Out: ("progress", fraction) · ("result", frames) followed by so many frames of bytes · ("problem", document) ·
     ("stopped",)

It ends when the other end of the pipe is closed. A result is sent as pickle protocol 5 with its arrays out of band,
each in a frame of its own: serialising them makes no copy.
"""

import os
import pickle
import signal
import time
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any

from vfcore.runs.memory import keep_freed_memory

NICENESS = 10
PROGRESS_EVERY_S = 0.1


def serve_work(pipe: Connection) -> None:
    """Main function of a worker process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C in a terminal reaches the whole group; the server ends us
    os.nice(NICENESS)
    keep_freed_memory()
    while True:
        try:
            order, *rest = pipe.recv()
            if order == "run":
                _answer(pipe, *rest)
        except (EOFError, ConnectionError):
            return


def _answer(pipe: Connection, function: Callable[..., Any], arguments: tuple[Any, ...]) -> None:
    from vfcore.errors import Cancelled
    from vocalis.server.problems import problem_of

    try:
        result = function(*arguments, progress=_Throttled(pipe), stop=lambda: _stop_requested(pipe))
    except Cancelled:
        pipe.send(("stopped",))
    except EOFError:
        raise
    except Exception as error:
        pipe.send(("problem", problem_of(error)))
    else:
        frames: list[pickle.PickleBuffer] = []
        head = pickle.dumps(result, protocol=5, buffer_callback=frames.append)
        pipe.send(("result", len(frames) + 1))
        pipe.send_bytes(head)
        for frame in frames:
            pipe.send_bytes(frame.raw())


def read_result(pipe: Connection, frames: int) -> Any:
    """The other end of ("result", frames)."""
    head, *arrays = [pipe.recv_bytes() for _ in range(frames)]
    return pickle.loads(head, buffers=arrays)


def _stop_requested(pipe: Connection) -> bool:
    """Between chunks, only ("stop",) can be in the pipe."""
    return pipe.poll() and pipe.recv() == ("stop",)


class _Throttled:
    """Reports progress, but not more often than a person can see."""

    def __init__(self, pipe: Connection):
        self._pipe = pipe
        self._next = 0.0

    def __call__(self, fraction: float) -> None:
        now = time.monotonic()
        if now >= self._next:
            self._next = now + PROGRESS_EVERY_S
            self._pipe.send(("progress", fraction))
