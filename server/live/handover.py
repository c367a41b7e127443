"""The way out of the server for a played voice: the client's connection goes to the process of the voices.

Sound that passed through the server's own event loop would wake it a hundred times a second for every voice, and would
wait for whatever else the server does. So an accepted connection is handed over as it is, with the answer to its
handshake still unsaid, and the server has nothing to do with it until the voice is over. Where the socket itself
cannot go, because it is encrypted or the system does not hand sockets on, a pair of sockets goes in its place and
octets are carried between.

``HandsOver`` is what ``uvicorn.Config(ws=…)`` takes; a route finds ``hand_over`` by ``hand_over_of``.
"""

import asyncio
import os
import socket
import sys
from collections.abc import Awaitable, Callable
from typing import NamedTuple, cast

from starlette.types import Scope
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

EXTENSION = "vocalis.hand_over"


class Handed(NamedTuple):
    """A connection that somebody else goes on with: ``greeting`` is to be sent first, web socket frames follow."""

    socket: socket.socket
    greeting: bytes


class HandsOver(WebSocketsSansIOProtocol):
    """Uvicorn's web socket, which can be handed over before it is accepted."""

    _handed_over = False
    _pipe: asyncio.Transport | None = None  # to the other one of the pair

    async def run_asgi(self) -> None:
        cast(dict, self.scope["extensions"])[EXTENSION] = self.hand_over
        await super().run_asgi()

    async def hand_over(self) -> Handed:
        """The connection; from now on the server itself neither reads from it nor writes to it."""
        self.transport.pause_reading()
        self.conn.send_response(self.response)
        greeting = b"".join(self.conn.data_to_send())
        self.handshake_complete = self.close_sent = self._handed_over = True  # nothing more is said from here
        if can_go(self.transport):
            descriptor = os.dup(self.transport.get_extra_info("socket").fileno())
            return Handed(socket.socket(fileno=descriptor), greeting)
        ours, theirs = socket.socketpair()
        self._pipe, _ = await self.loop.create_connection(lambda: _Back(self.transport), sock=ours)
        self.transport.resume_reading()
        return Handed(theirs, greeting)

    def data_received(self, data: bytes) -> None:
        if self._pipe is not None:
            self._pipe.write(data)
        elif not self._handed_over:
            super().data_received(data)

    def pause_writing(self) -> None:
        super().pause_writing()
        if self._pipe is not None:
            self._pipe.pause_reading()

    def resume_writing(self) -> None:
        super().resume_writing()
        if self._pipe is not None:
            self._pipe.resume_reading()

    def connection_lost(self, exc: Exception | None) -> None:
        if self._pipe is not None:
            self._pipe.close()
        super().connection_lost(exc)

    def shutdown(self) -> None:
        if self._handed_over:
            self.queue.put_nowait({"type": "websocket.disconnect", "code": 1012})
        super().shutdown()


class _Back(asyncio.Protocol):
    """What the process of the voices says, to the client."""

    def __init__(self, client: asyncio.Transport):
        self._client = client

    def data_received(self, data: bytes) -> None:
        self._client.write(data)

    def connection_lost(self, exc: Exception | None) -> None:
        self._client.close()


def can_go(transport: asyncio.Transport) -> bool:
    """Whether a connection's own socket can be given to another process."""
    return sys.platform != "win32" and transport.get_extra_info("sslcontext") is None


def hand_over_of(scope: Scope) -> Callable[[], Awaitable[Handed]] | None:
    """How a connection is handed over; None under a server that cannot."""
    return scope.get("extensions", {}).get(EXTENSION)
