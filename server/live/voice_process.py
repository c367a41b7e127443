"""The process that plays all live voices, with its kernels compiled once.

One thread makes every block, one voice after the other: threads of their own would compete for Python's lock at each
of the many short steps of a block, and a core that has just played one voice plays the next one twice as fast as an
idle core. The thread wakes when a block is due, and for control messages; see ``pace``.
"""

import gc
import logging
import os
import select
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import partial
from multiprocessing.connection import Connection
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from vocalis.server.live.player import Player

READY = "ready"
PRIORITY = -10
CLOSE_S = 0.3  # for the closing handshakes, when the server stops
SWITCH_S = 0.0005  # a voice that is being prepared releases Python's lock after this long


class VoiceLoop:
    """Plays the voices. ``add`` may be called from any thread."""

    def __init__(self) -> None:
        self._players: dict[Player, Callable[[], None]] = {}
        self._changed = threading.Condition()

    def add(self, player: "Player", ended: Callable[[], None]) -> None:
        """Play a voice; ``ended`` is called when it is over."""
        with self._changed:
            self._players = self._players | {player: ended}
            self._changed.notify_all()

    def run(self) -> None:
        """Make the blocks of every voice when they are due, for ever."""
        while True:
            with self._changed:
                while not self._players:
                    self._changed.wait()
                players = self._players
            now = time.monotonic()
            for player in players:
                if player.is_due(now) and not _continues(player.turn):
                    self._remove(player)
            for player in _with_messages(self._players):
                if not _continues(player.receive):
                    self._remove(player)

    def wait_until_empty(self, within_s: float) -> None:
        """Wait until all voices have ended, for so long at most."""
        with self._changed:
            self._changed.wait_for(lambda: not self._players, within_s)

    def _remove(self, player: "Player") -> None:
        player.close()
        with self._changed:
            ended = self._players[player]
            self._players = {other: call for other, call in self._players.items() if other is not player}
            self._changed.notify_all()
        ended()


def _with_messages(players: "Iterable[Player]") -> "list[Player]":
    """Wait until a voice is due, or a client has sent something; the voices of such clients."""
    if not players:
        return []
    seconds = min(player.wakes_s for player in players) - time.monotonic()
    return select.select([player for player in players if player.is_open], (), (), max(0.0, seconds))[0]


def _continues(act: Callable[[], bool]) -> bool:
    try:
        return act()
    except Exception:  # a fault in one voice ends that voice, never the others
        logging.exception("a live voice failed")
        return False


def serve_voices(control: Connection) -> None:
    """Play for the clients that come over ``control`` until it is closed. Sends READY once the kernels are loaded.

    A client comes as (number, socket, greeting), and (number,) disconnects it; its number is sent back when it has
    left.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the server handles Ctrl-C, and closes ``control``
    with suppress(OSError, AttributeError):  # where it is allowed: sound comes before pictures
        os.setpriority(os.PRIO_PROCESS, 0, PRIORITY)
    from vocalis.server.live.client import Client
    from vocalis.server.live.forms import load_compiled
    from vocalis.server.live.player import Player
    from vocalis.server.warmup.live import warm_up_voice

    sys.setswitchinterval(SWITCH_S)
    warm_up_voice()
    loop = VoiceLoop()
    threading.Thread(target=loop.run, name="voices", daemon=True).start()
    gc.collect()
    gc.freeze()  # later collections look only at what voices leave behind, which takes a moment
    control.send(READY)
    threading.Thread(target=load_compiled, name="form", daemon=True).start()
    players: dict[int, Player] = {}
    sending = threading.Lock()

    def ended(number: int) -> None:
        players.pop(number, None)
        with sending, suppress(OSError):
            control.send(number)

    while True:
        try:
            number, *client = control.recv()
        except (EOFError, OSError):
            break
        if client:
            players[number] = player = Player(Client(*client))
            arguments = (player, loop, partial(ended, number))
            threading.Thread(target=_prepare, args=arguments, name="voice", daemon=True).start()
        elif number in players:
            players[number].stop()
    for player in list(players.values()):
        player.stop()
    loop.wait_until_empty(CLOSE_S)


def _prepare(player: "Player", loop: VoiceLoop, ended: Callable[[], None]) -> None:
    continues = False
    try:
        continues = player.prepare()
    finally:
        if continues:
            loop.add(player, ended)
        else:
            player.close()
            ended()
