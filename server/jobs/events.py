"""Events of jobs, as a numbered log that any number of streams can read from any position.

Only the latest ``progress`` event of each job is kept, so a slow reader is never more than one such event per job
behind; of ``point`` events only the latest ones are kept. Event ids are ``<boot>-<number>``. After a restart, or when
too many events have passed, a reader gets the present state instead of a gap.
"""

import asyncio
import secrets
import threading
from collections import Counter, OrderedDict, deque
from collections.abc import AsyncIterator, Callable
from typing import Any, NamedTuple

PROGRESS, POINT, DONE = "progress", "point", "done"


class Event(NamedTuple):
    """``data`` is the job's document at that moment; for POINT events, the points."""

    id: str
    name: str
    client: str
    job_id: str
    data: dict[str, Any]


class EventLog:
    """Written from any thread, read in the event loop that ``bind`` was called in."""

    def __init__(self, kept: int = 5000, points_kept: int = 500):
        self._kept, self._points_kept = kept, points_kept
        self._points: deque[int] = deque()
        self._boot = secrets.token_hex(4)
        self._log: OrderedDict[int, Event] = OrderedDict()
        self._last_progress: dict[str, int] = {}
        self._number = 0
        self._dropped = 0
        self._lock = threading.Lock()
        self._loop: asyncio.AbstractEventLoop | None = None
        self._readers: set[asyncio.Event] = set()
        self.closed = False
        self.streams: Counter[str] = Counter()

    def bind(self) -> None:
        """Wake readers in the running event loop."""
        self._loop = asyncio.get_running_loop()

    def close(self) -> None:
        """End every stream."""
        self.closed = True
        self._wake()

    def publish(self, name: str, client: str, job_id: str, data: dict[str, Any]) -> None:
        """Append an event; a progress event replaces the last one of its job."""
        with self._lock:
            self._number += 1
            number = self._number
            if name != POINT and (last := self._last_progress.pop(job_id, None)) is not None:
                self._log.pop(last, None)
            if name == PROGRESS:
                self._last_progress[job_id] = number
            if name == POINT:
                self._points.append(number)
            self._log[number] = Event(f"{self._boot}-{number}", name, client, job_id, data)
            while len(self._log) > self._kept:
                self._dropped, _ = self._log.popitem(last=False)
            while len(self._points) > self._points_kept:
                oldest = self._points.popleft()
                if self._log.pop(oldest, None) is not None:
                    self._dropped = max(self._dropped, oldest)
        if self._loop is not None and not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._wake)

    def position(self, event_id: str | None) -> int | None:
        """The number of an event id; None when the log cannot go on from there without a gap."""
        boot, _, number = (event_id or "").partition("-")
        if boot != self._boot or not number.isdecimal() or len(number) > 18:
            return None
        return int(number) if self._dropped <= int(number) <= self._number else None

    def since(self, position: int, client: str, job_id: str | None) -> tuple[list[Event], int]:
        """Events after a position, of one client or one job, and the position then reached."""
        with self._lock:
            found = [
                event
                for number, event in self._log.items()
                if number > position and (event.job_id == job_id if job_id else event.client == client)
            ]
            return found, self._number

    async def follow(
        self, client: str, job_id: str | None, last_id: str | None, present: Callable[[], list[Event]]
    ) -> AsyncIterator[Event]:
        """Events after ``last_id``, or the present state and then what follows; a job's ends with its ``done``."""
        wake = asyncio.Event()
        self._readers.add(wake)
        try:
            position = self.position(last_id)
            if position is None:
                position = self._number  # first: an event in between is then sent twice rather than not at all
                current = await asyncio.to_thread(present)
                events = [event._replace(id=f"{self._boot}-{position}") for event in current]
            else:
                events, position = self.since(position, client, job_id)
            while not self.closed:
                for event in events:
                    yield event
                    if job_id and event.name == DONE:
                        return
                await wake.wait()
                wake.clear()
                events, position = self.since(position, client, job_id)
        finally:
            self._readers.discard(wake)

    def _wake(self) -> None:
        for reader in self._readers:
            reader.set()
