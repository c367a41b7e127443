"""The process in which voices are played, kernels compiled once.

One thread makes every block, voice after voice: threads of their own would fight for Python's lock at each of the
many short stretches of a block, and a core that has just played one voice plays the next one twice as fast as one
that was woken for it. It wakes when a block is due, and for a word of a hand: the blocks that are due before its next
word are then made at once, which hears the hand as soon and wakes sixty times a second instead of a hundred.
"""

import gc
import logging
import os
import select
import signal
import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from multiprocessing.connection import Connection

WARM = "warm"
PRIORITY = -10
FAREWELL_S = 0.3  # for the clients, when the server stops
SWITCH_S = 0.0005  # a voice that is being prepared hands Python's lock back after this long


class Stage:
    """The voices that are played. ``enter`` may be called from any thread."""

    def __init__(self) -> None:
        self._players: dict = {}
        self._there = threading.Condition()

    def enter(self, player, over: Callable[[], None]) -> None:
        """Play it; ``over`` is called when it has ended."""
        with self._there:
            self._players = self._players | {player: over}
            self._there.notify_all()

    def run(self) -> None:
        """Give every voice its turns, for ever."""
        while True:
            with self._there:
                while not self._players:
                    self._there.wait()
                players = self._players
            now = time.monotonic()
            for player in players:
                if player.is_due(now) and not _goes_on(player.turn):
                    self._leave(player)
            for player in _spoken_to(self._players):
                if not _goes_on(player.hear):
                    self._leave(player)

    def end(self, within_s: float) -> None:
        """Wait until nobody plays, for so long at most."""
        with self._there:
            self._there.wait_for(lambda: not self._players, within_s)

    def _leave(self, player) -> None:
        player.close()
        with self._there:
            over = self._players[player]
            self._players = {other: told for other, told in self._players.items() if other is not player}
            self._there.notify_all()
        over()


def _spoken_to(players) -> list:
    """Wait until one is due, or one of those who listen is spoken to, and say who was."""
    if not players:
        return []
    seconds = min(player.wakes_s for player in players) - time.monotonic()
    return select.select([player for player in players if player.listens], (), (), max(0.0, seconds))[0]


def _goes_on(act: Callable[[], bool]) -> bool:
    try:
        return act()
    except Exception:  # a fault in one voice ends that voice, never the others
        logging.exception("a played voice broke down")
        return False


def serve_voices(control: Connection) -> None:
    """Play for the clients that come over ``control`` until it is closed. Says WARM once the kernels are there.

    A client comes as (number, socket, greeting), (number,) sends it away; its number goes back when it has left.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the server's affair; it closes ``control``
    with suppress(OSError, AttributeError):  # where it is allowed: what sounds comes before what is looked at
        os.setpriority(os.PRIO_PROCESS, 0, PRIORITY)
    from vocalis.server.live.client import Client
    from vocalis.server.live.player import Player
    from vocalis.server.warmup.live import rehearse

    sys.setswitchinterval(SWITCH_S)
    rehearse()
    stage = Stage()
    threading.Thread(target=stage.run, name="stage", daemon=True).start()
    gc.collect()
    gc.freeze()  # what is there stays; a collection looks at what voices leave behind, a moment's work
    control.send(WARM)
    players: dict[int, Player] = {}
    telling = threading.Lock()

    def over(number: int) -> None:
        players.pop(number, None)
        with telling, suppress(OSError):
            control.send(number)

    while True:
        try:
            number, *client = control.recv()
        except (EOFError, OSError):
            break
        if client:
            players[number] = player = Player(Client(*client))
            arguments = (player, stage, partial(over, number))
            threading.Thread(target=_prepare, args=arguments, name="voice", daemon=True).start()
        elif number in players:
            players[number].hang_up()
    for player in list(players.values()):
        player.hang_up()
    stage.end(FAREWELL_S)


def _prepare(player, stage: Stage, over: Callable[[], None]) -> None:
    goes_on = False
    try:
        goes_on = player.prepare()
    finally:
        if goes_on:
            stage.enter(player, over)
        else:
            player.close()
            over()
