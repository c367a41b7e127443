"""The server's side of played voices: starts their process, hands clients over to it, and counts them."""

import asyncio
import multiprocessing
import threading
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager, suppress
from itertools import count
from multiprocessing.connection import Connection
from typing import Any

from vocalis.server.exceptions import NotReady, TooMany
from vocalis.server.live.handover import Handed
from vocalis.server.live.process import FAREWELL_S, WARM, serve_voices

_SPAWN = multiprocessing.get_context("spawn")
START_S = 60.0  # compiling on a slow machine


class VoiceHost:
    """At most ``most`` voices. Their process starts with the first one, and anew when it has died."""

    def __init__(self, most: int):
        self._most = most
        self.playing = 0
        self._process: Any = None
        self._control: Connection | None = None
        self._gone = threading.Event()  # set as soon as the process does not listen, before the system calls it dead
        self._starting = asyncio.Lock()
        self._numbers = count()
        self._over: dict[int, asyncio.Future[None]] = {}

    @asynccontextmanager
    async def place(self) -> AsyncIterator[Callable[[Handed], Awaitable[None]]]:
        """A place among the voices: what it gives plays for a client until it has left. Raises TooMany or NotReady."""
        if self.playing >= self._most:
            raise TooMany(
                f"{self.playing} voices are being played, the most this server takes (VOCALIS_LIVE_VOICES). "
                "Try again when one has stopped."
            )
        self.playing += 1
        try:
            await self._started()
            yield self._play
        finally:
            self.playing -= 1

    def close(self) -> None:
        """End every voice."""
        if self._process is not None:
            self._control.close()
            self._process.join(FAREWELL_S)
            self._process.kill()
            self._process.join(1.0)

    async def _play(self, client: Handed) -> None:
        try:
            number, over = self._hand(client)
        except OSError:  # the process has just died: this voice gets the next one
            self._gone.set()
            await self._started()
            number, over = self._hand(client)
        control, waiting = self._control, self._over
        try:
            client.socket.close()
            await over
        finally:
            waiting.pop(number, None)
            if not over.done() or over.cancelled():
                with suppress(OSError):
                    control.send((number,))

    def _hand(self, client: Handed) -> tuple[int, asyncio.Future[None]]:
        """Give a client to the process: its number there, and what is done when it has left."""
        number, over = next(self._numbers), asyncio.get_running_loop().create_future()
        self._control.send((number, *client))
        self._over[number] = over
        return number, over

    async def _started(self) -> None:
        async with self._starting:
            if self._process is not None and self._process.is_alive() and not self._gone.is_set():
                return
            self._gone, self._over = threading.Event(), {}
            self._control, theirs = _SPAWN.Pipe()
            self._process = _SPAWN.Process(target=serve_voices, args=(theirs,), name="vocalis-voices", daemon=True)
            await asyncio.to_thread(self._process.start)
            theirs.close()
            try:
                warm = await asyncio.to_thread(self._control.poll, START_S) and self._control.recv() == WARM
            except EOFError:
                warm = False
            if not warm:
                self.close()
                raise NotReady("Not ready: the process that plays voices did not start.")
            hearing = (self._control, asyncio.get_running_loop(), self._over, self._gone)
            threading.Thread(target=_hear, args=hearing, name="voices", daemon=True).start()


def _hear(
    control: Connection,
    loop: asyncio.AbstractEventLoop,
    over: dict[int, asyncio.Future[None]],
    gone: threading.Event,
) -> None:
    """Note which clients have left; all, when the process ends."""

    def left(*numbers: int) -> None:
        for number in numbers or tuple(over):
            if number in over and not over[number].done():
                over[number].set_result(None)

    with suppress(RuntimeError):  # the loop is closed
        with suppress(EOFError, OSError):
            while True:
                loop.call_soon_threadsafe(left, control.recv())
        gone.set()
        loop.call_soon_threadsafe(left)
