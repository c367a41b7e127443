"""Calls that are answered while the client waits: a few at a time in threads, the newest first.

The kernels release the interpreter lock, so threads do run in parallel. While the user moves a slider, only the answer
to its latest position matters. So a free slot goes to the newest call, a call whose client has left is not computed,
and when too many wait the oldest is refused. The threads are daemons: a running computation never delays the end of
the server.
"""

import asyncio
import threading
from collections.abc import Awaitable, Callable
from contextlib import suppress
from functools import partial
from typing import TypeVar

from vocalis.server.exceptions import ClientLeft, Superseded

T = TypeVar("T")


class LatestFirstLimiter:
    """At most ``slots`` calls run at a time, and at most ``waiting`` more wait."""

    def __init__(self, slots: int, waiting: int, name: str):
        self._free = slots
        self._most_waiting = waiting
        self._waiting: list[asyncio.Future] = []
        self._name = name

    async def run(self, call: Callable[[], T], gone: Callable[[], Awaitable[bool]] | None = None) -> T:
        """``call()`` in a thread, once a slot is free. Raises Superseded, ClientLeft, or what the call raises."""
        await self._acquire()
        try:
            if gone is not None and await gone():
                raise ClientLeft("The connection was closed before the call was computed.")
            return await self._in_thread(call)
        finally:
            self._release()

    async def _acquire(self) -> None:
        if self._free:
            self._free -= 1
            return
        place = asyncio.get_running_loop().create_future()
        self._waiting.append(place)
        if len(self._waiting) > self._most_waiting:
            self._waiting.pop(0).set_exception(
                Superseded(f"Newer calls took all {self._most_waiting} places in the queue.")
            )
        try:
            await place
        except asyncio.CancelledError:
            if place in self._waiting:
                self._waiting.remove(place)
            elif place.done() and not place.cancelled() and place.exception() is None:
                self._release()
            raise

    def _release(self) -> None:
        """Give the slot to the newest call that waits."""
        while self._waiting:
            place = self._waiting.pop()
            if not place.done():
                place.set_result(None)
                return
        self._free += 1

    async def _in_thread(self, call: Callable[[], T]) -> T:
        loop = asyncio.get_running_loop()
        outcome: asyncio.Future[T] = loop.create_future()

        def work() -> None:
            try:
                settle = partial(_settle, outcome, outcome.set_result, call())
            except BaseException as error:
                settle = partial(_settle, outcome, outcome.set_exception, error)
            with suppress(RuntimeError):  # the loop is closed: the server has ended in the meantime
                loop.call_soon_threadsafe(settle)

        threading.Thread(target=work, name=self._name, daemon=True).start()
        return await outcome


def _settle(outcome: asyncio.Future, settle: Callable, value: object) -> None:
    if not outcome.done():  # it is done when the caller was cancelled
        settle(value)
