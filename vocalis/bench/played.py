"""The share of a core that one played voice takes: everything that the voice process does for it.

The real player (vocalis/server/live/player.py) plays in this thread for a client at the other end of a socket: it reads
and checks the control messages, solves postures, assembles, marches, filters, sends the sound and the pictures, a block
every 10 ms. The client moves a muscle before every block. Only the player is timed, in CPU time of the thread.
"""

import json
import socket
import time
from contextlib import suppress

from websockets.frames import Frame, Opcode

from vfcore.runs.gesture.voice import BLOCK_S
from vocalis.bench.forms import LEFT
from vocalis.server.live.client import Client
from vocalis.server.live.player import Player

SETTLE_S = 0.5  # the onset, not timed
#: Two different folds, whose tension grows with the swing.
VOICE = {"model": {"stretch": "finite"}, "left": LEFT}
MOVES = (0.30, 0.32, 0.34, 0.32)  # CT


def share_of_a_core(seconds: float, voice: dict | None = None) -> list[float]:
    """CPU time over time, of each second of ``seconds``, of ``voice``: a first message, by default VOICE."""
    ours, theirs = socket.socketpair()
    player = Player(Client(theirs, b""))
    ours.setblocking(False)
    ours.send(_text(VOICE if voice is None else voice))
    if not player.prepare():
        raise RuntimeError("the voice did not begin")
    try:
        _play(player, ours, SETTLE_S)
        return [_play(player, ours, 1.0) for _ in range(max(1, round(seconds)))]
    finally:
        player.close()
        ours.close()


def _play(player: Player, client: socket.socket, seconds: float) -> float:
    """Play in real time for ``seconds``; CPU time over time."""
    began, used, blocks = time.monotonic(), 0.0, 0
    while (now := time.monotonic()) < began + seconds:
        if now < began + blocks * BLOCK_S:
            time.sleep(began + blocks * BLOCK_S - now)
        client.send(_text({"activation": {"ct": MOVES[blocks % len(MOVES)]}}))
        with suppress(BlockingIOError):
            while client.recv(1 << 20):
                pass
        cpu = time.thread_time()
        going = player.receive() and (not player.is_due(time.monotonic()) or player.turn())
        used += time.thread_time() - cpu
        if not going:
            raise RuntimeError("the voice ended")
        blocks += 1
    return used / (time.monotonic() - began)


def _text(message: dict) -> bytes:
    return Frame(Opcode.TEXT, json.dumps(message).encode()).serialize(mask=True)
