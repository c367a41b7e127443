"""WS /live: a voice to play, see vocalis_server/live/protocol.py for what is said."""

import asyncio
import time
from contextlib import suppress

from fastapi import APIRouter, WebSocket, WebSocketDisconnect
from starlette.websockets import WebSocketState

from vfcore.errors import ParameterError, VocalisError
from vocalis_server.live.host import Line, Slow
from vocalis_server.live.protocol import read_message
from vocalis_server.problems import problem_of
from vocalis_server.services import Services

router = APIRouter()
MESSAGES_PER_S = 200  # a hand makes 60; twice as many may come at once
TRY_AGAIN_LATER, POLICY = 1013, 1008


class Flooding(Exception):
    """More messages than a hand can make."""


class Meter:
    """A token bucket."""

    def __init__(self, per_second: float):
        self._per_second, self._left, self._at = per_second, 2.0 * per_second, time.monotonic()

    def count(self) -> None:
        """One message more; Flooding when it is one too many."""
        now = time.monotonic()
        self._left = min(2.0 * self._per_second, self._left + (now - self._at) * self._per_second) - 1.0
        self._at = now
        if self._left < 0:
            raise Flooding


@router.websocket("/live")
async def live(socket: WebSocket) -> None:
    """Sound for as long as the client stays. The guard has seen host, origin and token before."""
    shared: Services = socket.app.state.services
    await socket.accept()
    code, reason = 1000, ""
    try:
        async with shared.voices.voice() as line:
            await _talk(socket, line)
    except VocalisError as error:
        problem = problem_of(error)
        with suppress(WebSocketDisconnect, RuntimeError):
            await socket.send_json({"type": "problem", "problem": problem, "over": True})
        code, reason = TRY_AGAIN_LATER, problem["title"]
    except Slow:
        code, reason = POLICY, "the sound is not taken as fast as it is made"
    except Flooding:
        code, reason = POLICY, f"more than {MESSAGES_PER_S} messages a second"
    except WebSocketDisconnect:
        return
    if socket.application_state is WebSocketState.CONNECTED:
        with suppress(WebSocketDisconnect, RuntimeError):
            await socket.close(code, reason)


async def _talk(socket: WebSocket, line: Line) -> None:
    """Both directions at once, until one ends."""
    tasks = [asyncio.create_task(_hear(socket, line)), asyncio.create_task(_speak(socket, line))]
    try:
        done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        for task in done:
            task.result()
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)


async def _hear(socket: WebSocket, line: Line) -> None:
    meter = Meter(MESSAGES_PER_S)
    while True:
        message = await socket.receive()
        if message["type"] == "websocket.disconnect":
            raise WebSocketDisconnect(message.get("code", 1005))
        meter.count()
        try:
            text = message.get("text")
            if text is None:
                raise ParameterError("message", "is binary", "text: an object in JSON")
            line.send(read_message(text))
        except ParameterError as error:
            await socket.send_json({"type": "problem", "problem": problem_of(error), "over": False})


async def _speak(socket: WebSocket, line: Line) -> None:
    while (frame := await line.frame()) is not None:
        if isinstance(frame, bytes):
            await socket.send_bytes(frame)
        else:
            await socket.send_text(frame)
