"""WS /live: a voice to play; server/live/protocol.py describes the messages."""

import asyncio
from collections.abc import Awaitable
from contextlib import suppress
from typing import Any

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from vfcore.errors import VocalisError
from vocalis.server.exceptions import NotReady
from vocalis.server.live.handover import hand_over_of
from vocalis.server.problems import problem_of
from vocalis.server.services import Services

router = APIRouter()
TRY_AGAIN_LATER = 1013


@router.websocket("/live")
async def live(socket: WebSocket) -> None:
    """Sound for as long as the client stays. The guard has seen host, origin and token before."""
    shared: Services = socket.app.state.services
    try:
        hand_over = hand_over_of(socket.scope)
        if hand_over is None:
            raise NotReady("Voices can be played where `vocalis serve` runs the server.")
        async with shared.voices.place() as play:
            await socket.receive()  # the connection request
            await _either(play(await hand_over()), socket.receive())  # the server stops
    except VocalisError as error:
        await _refuse(socket, problem_of(error))


async def _refuse(socket: WebSocket, problem: dict) -> None:
    with suppress(WebSocketDisconnect, RuntimeError):
        await socket.accept()
        await socket.send_json({"type": "problem", "problem": problem, "over": True})
        await socket.close(TRY_AGAIN_LATER, problem["title"])


async def _either(*awaitables: Awaitable[Any]) -> None:
    """Until one of them ends."""
    tasks = [asyncio.ensure_future(one) for one in awaitables]
    try:
        done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        for task in done:
            task.result()
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
