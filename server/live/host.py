"""The server's side of played voices: starts their process, hands out voices, and counts them."""

import asyncio
import json
import multiprocessing
import threading
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from multiprocessing.connection import Connection
from typing import Any

from vocalis_server.live.process import WARM, serve_voices
from vocalis_server.live.protocol import HANG_UP, TEXT
from vocalis_server.problems import NotReady, TooMany

_SPAWN = multiprocessing.get_context("spawn")
START_S = 60.0  # compiling on a slow machine
#: What a client that does not read may have waiting: half a second of sound with its state frames.
MOST_WAITING = 70


class Slow(Exception):
    """The client does not take its sound."""


class Line:
    """One voice as the server sees it."""

    def __init__(self, link: Connection):
        self._link = link
        self._frames: asyncio.Queue[bytes | str | None] = asyncio.Queue()
        self._loop = asyncio.get_running_loop()
        try:
            self._loop.add_reader(link.fileno(), self._take)
        except (NotImplementedError, OSError, ValueError):  # a system whose loop cannot wait for pipes
            threading.Thread(target=self._read, name="voice line", daemon=True).start()

    def send(self, message: dict[str, Any]) -> None:
        """A message for the voice; one that has ended hears nothing."""
        with suppress(OSError):
            self._link.send_bytes(json.dumps(message).encode())

    async def frame(self) -> bytes | str | None:
        """The next frame, sound or text; None when the voice has ended. Raises Slow when too many wait."""
        if self._frames.qsize() > MOST_WAITING:
            raise Slow
        return await self._frames.get()

    def close(self) -> None:
        """Hang up: the voice ends with its next block, and then the line."""
        with suppress(OSError):
            self._link.send_bytes(HANG_UP)

    def _take(self) -> None:
        """A frame has come: one a turn, so that no line keeps the others waiting."""
        try:
            frame = self._link.recv_bytes()
        except (EOFError, OSError):
            self._loop.remove_reader(self._link.fileno())
            self._link.close()
            self._frames.put_nowait(None)
        else:
            self._frames.put_nowait(decoded(frame))

    def _read(self) -> None:
        with suppress(EOFError, OSError, RuntimeError):  # RuntimeError: the loop is closed
            while True:
                self._hand_over(decoded(self._link.recv_bytes()))
        self._link.close()
        with suppress(RuntimeError):
            self._hand_over(None)

    def _hand_over(self, frame: bytes | str | None) -> None:
        self._loop.call_soon_threadsafe(self._frames.put_nowait, frame)


class Host:
    """At most ``most`` voices. Their process starts with the first one, and anew when it has died."""

    def __init__(self, most: int):
        self._most = most
        self.playing = 0
        self._process: Any = None
        self._control: Connection | None = None
        self._starting = asyncio.Lock()

    @asynccontextmanager
    async def voice(self) -> AsyncIterator[Line]:
        """A voice for as long as the block lasts. Raises TooMany or NotReady."""
        if self.playing >= self._most:
            raise TooMany(
                f"{self.playing} voices are being played, the most this server takes (VOCALIS_LIVE_VOICES). "
                "Try again when one has stopped."
            )
        self.playing += 1
        line = None
        try:
            await self._started()
            ours, theirs = _SPAWN.Pipe()
            self._control.send(theirs)
            theirs.close()
            line = Line(ours)
            yield line
        finally:
            self.playing -= 1
            if line is not None:
                line.close()

    def close(self) -> None:
        """End every voice."""
        if self._process is not None:
            self._process.kill()
            self._process.join(1.0)

    async def _started(self) -> None:
        async with self._starting:
            if self._process is not None and self._process.is_alive():
                return
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


def decoded(frame: bytes) -> bytes | str:
    """A frame of the voices' process as it goes to the client."""
    return frame[1:].decode() if frame[:1] == TEXT else frame[1:]
