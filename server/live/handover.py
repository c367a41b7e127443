"""Passes the connection of a live voice from the server to the voice process.

If sound passed through the server's event loop, every voice would wake it a hundred times a second, and would wait for
whatever else the server does. So an accepted connection is passed on as it is, with the answer to its handshake not
yet sent, and the server does nothing with it until the voice has ended. Where the socket itself cannot be passed on,
because it is encrypted or the system does not support that, one end of a socket pair is passed on in its place and the
server copies bytes between the two.

``HandoverProtocol`` is for ``uvicorn.Config(ws=…)``; a route gets ``hand_over`` from ``hand_over_of``.
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


class Connected(NamedTuple):
    """A connection to be taken over: ``greeting`` is to be sent first, WebSocket frames follow."""

    socket: socket.socket
    greeting: bytes


class HandoverProtocol(WebSocketsSansIOProtocol):
    """Uvicorn's WebSocket, which can be handed over before it is accepted."""

    _handed_over = False
    _pipe: asyncio.Transport | None = None  # to the other end of the socket pair

    async def run_asgi(self) -> None:
        cast(dict, self.scope["extensions"])[EXTENSION] = self.hand_over
        await super().run_asgi()

    async def hand_over(self) -> Connected:
        """The connection; from now on the server itself neither reads from it nor writes to it."""
        self.transport.pause_reading()
        self.conn.send_response(self.response)
        greeting = b"".join(self.conn.data_to_send())
        self.handshake_complete = self.close_sent = self._handed_over = True  # uvicorn sends nothing more
        if can_pass_on(self.transport):
            descriptor = os.dup(self.transport.get_extra_info("socket").fileno())
            return Connected(socket.socket(fileno=descriptor), greeting)
        own_end, other_end = socket.socketpair()
        self._pipe, _ = await self.loop.create_connection(lambda: _ToClient(self.transport), sock=own_end)
        self.transport.resume_reading()
        return Connected(other_end, greeting)

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


class _ToClient(asyncio.Protocol):
    """Copies what the voice process sends to the client."""

    def __init__(self, client: asyncio.Transport):
        self._client = client

    def data_received(self, data: bytes) -> None:
        self._client.write(data)

    def connection_lost(self, exc: Exception | None) -> None:
        self._client.close()


def can_pass_on(transport: asyncio.Transport) -> bool:
    """Whether a connection's own socket can be passed to another process."""
    return sys.platform != "win32" and transport.get_extra_info("sslcontext") is None


def hand_over_of(scope: Scope) -> Callable[[], Awaitable[Connected]] | None:
    """How a connection is handed over; None under a server that cannot."""
    return scope.get("extensions", {}).get(EXTENSION)
