"""Calls answered while the client waits: a few at a time in threads, the newest first.

The kernels release the interpreter lock, so threads do run side by side. When a hand moves a slider,
the answer to its last position matters and the earlier ones no longer do: a free slot goes to the call
that came last, a call whose client has left is not computed at all, and when too many wait the oldest
is turned away. The threads are daemons: what is being computed never holds up the end of the server.
"""

import asyncio
import threading
from collections.abc import Awaitable, Callable
from contextlib import suppress
from functools import partial
from typing import TypeVar

from vfcore.errors import VocalisError

T = TypeVar("T")


class ClientLeft(VocalisError):
    """Nobody waits for the answer any more."""


class Overtaken(VocalisError):
    """Newer calls took all the places in which to wait."""

    retry_after_s = 1


class Interactive:
    """``slots`` calls at a time, ``waiting`` more in line."""

    def __init__(self, slots: int, waiting: int, name: str):
        self._free = slots
        self._most_waiting = waiting
        self._line: list[asyncio.Future] = []
        self._name = name

    async def run(self, call: Callable[[], T], gone: Callable[[], Awaitable[bool]] | None = None) -> T:
        """``call()`` in a thread, when it is its turn. Raises Overtaken, ClientLeft, or what the call raises."""
        await self._turn()
        try:
            if gone is not None and await gone():
                raise ClientLeft("The connection was closed before its turn came.")
            return await self._in_thread(call)
        finally:
            self._next()

    async def _turn(self) -> None:
        if self._free:
            self._free -= 1
            return
        place = asyncio.get_running_loop().create_future()
        self._line.append(place)
        if len(self._line) > self._most_waiting:
            self._line.pop(0).set_exception(
                Overtaken(f"Newer calls took all {self._most_waiting} places in which calls may wait for their turn.")
            )
        try:
            await place
        except asyncio.CancelledError:
            if place in self._line:
                self._line.remove(place)
            elif place.done() and not place.cancelled() and place.exception() is None:
                self._next()
            raise

    def _next(self) -> None:
        """Hand the slot to whoever came last."""
        while self._line:
            place = self._line.pop()
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
            with suppress(RuntimeError):  # the loop is closed: the server has ended meanwhile
                loop.call_soon_threadsafe(settle)

        threading.Thread(target=work, name=self._name, daemon=True).start()
        return await outcome


def _settle(outcome: asyncio.Future, settle: Callable, value: object) -> None:
    if not outcome.done():  # it is when whoever waited was cancelled
        settle(value)
