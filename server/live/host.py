"""The server's side of live voices: starts the voice process, passes clients to it, and counts them."""

import asyncio
import multiprocessing
import threading
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager, suppress
from itertools import count
from multiprocessing.connection import Connection
from multiprocessing.context import SpawnProcess

from vocalis.server.exceptions import NotReady, TooMany
from vocalis.server.live.handover import Connected
from vocalis.server.live.voice_process import CLOSE_S, READY, serve_voices

_SPAWN = multiprocessing.get_context("spawn")
START_S = 60.0  # compiling on a slow machine


class _VoiceProcess:
    """One voice process and the clients in it. Replaced by another one when it has died."""

    def __init__(self, process: SpawnProcess, control: Connection):
        self.process, self.control = process, control
        self.gone = threading.Event()  # set as soon as the process does not answer, before the system reports its end
        self.ends: dict[int, asyncio.Future[None]] = {}

    @property
    def is_alive(self) -> bool:
        return self.process.is_alive() and not self.gone.is_set()

    def close(self) -> None:
        """End every voice."""
        self.control.close()
        self.process.join(CLOSE_S)
        self.process.kill()
        self.process.join(1.0)

    def watch(self, loop: asyncio.AbstractEventLoop) -> None:
        """Note which clients have left; all of them when the process ends. Main function of a thread."""

        def left(*numbers: int) -> None:
            for number in numbers or tuple(self.ends):
                if number in self.ends and not self.ends[number].done():
                    self.ends[number].set_result(None)

        with suppress(RuntimeError):  # the loop is closed
            with suppress(EOFError, OSError):
                while True:
                    loop.call_soon_threadsafe(left, self.control.recv())
            self.gone.set()
            loop.call_soon_threadsafe(left)


class VoiceHost:
    """At most ``most`` voices. Their process starts with the first one, and again after it has died."""

    def __init__(self, most: int):
        self._most = most
        self.playing = 0
        self._current: _VoiceProcess | None = None
        self._starting = asyncio.Lock()
        self._numbers = count()

    @asynccontextmanager
    async def place(self) -> AsyncIterator[Callable[[Connected], Awaitable[None]]]:
        """Reserve a voice; the function it gives plays for a client until that has left. Raises TooMany or NotReady."""
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
        if self._current is not None:
            self._current.close()

    async def _play(self, client: Connected) -> None:
        voices = await self._started()
        try:
            number, end = self._pass_on(client, voices)
        except OSError:  # the process has just died: this voice gets the next one
            voices.gone.set()
            voices = await self._started()
            number, end = self._pass_on(client, voices)
        try:
            client.socket.close()
            await end
        finally:
            voices.ends.pop(number, None)
            if not end.done() or end.cancelled():
                with suppress(OSError):
                    voices.control.send((number,))

    def _pass_on(self, client: Connected, voices: _VoiceProcess) -> tuple[int, asyncio.Future[None]]:
        """Pass a client to the process: its number there, and a future that is done when it has left."""
        number, end = next(self._numbers), asyncio.get_running_loop().create_future()
        voices.control.send((number, *client))
        voices.ends[number] = end
        return number, end

    async def _started(self) -> _VoiceProcess:
        async with self._starting:
            if self._current is not None and self._current.is_alive:
                return self._current
            control, other_end = _SPAWN.Pipe()
            process = _SPAWN.Process(target=serve_voices, args=(other_end,), name="vocalis-voices", daemon=True)
            self._current = voices = _VoiceProcess(process, control)
            await asyncio.to_thread(process.start)
            other_end.close()
            try:
                ready = await asyncio.to_thread(control.poll, START_S) and control.recv() == READY
            except EOFError:
                ready = False
            if not ready:
                voices.close()
                raise NotReady("Not ready: the process that plays voices did not start.")
            threading.Thread(
                target=voices.watch, args=(asyncio.get_running_loop(),), name="voices", daemon=True
            ).start()
            return voices
