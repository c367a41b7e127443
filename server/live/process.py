"""The process in which voices are played, kernels compiled once.

One thread makes every block, voice after voice: threads of their own would fight for Python's lock at each of the
many short stretches of a block, and a core that has just played one voice plays the next one twice as fast as one
that was woken for it.
"""

import logging
import os
import signal
import sys
import threading
import time
from contextlib import suppress
from multiprocessing.connection import Connection

WARM = "warm"
EARLY_S = 0.002  # a voice that is due so soon is played along with the one before
PRIORITY = -10
SWITCH_S = 0.0005  # a voice that is being prepared hands Python's lock back after this long


class Stage:
    """The voices that are played. ``enter`` may be called from any thread."""

    def __init__(self) -> None:
        self._players: list = []
        self._there = threading.Condition()

    def enter(self, player) -> None:
        with self._there:
            self._players = [*self._players, player]
            self._there.notify()

    def run(self) -> None:
        """Give every voice its turns, for ever."""
        while True:
            with self._there:
                while not self._players:
                    self._there.wait()
                players = self._players
            for player in players:
                if player.due_s <= time.monotonic() + EARLY_S and not _turn(player):
                    self._leave(player)
            time.sleep(max(0.0, min((player.due_s for player in players), default=0.0) - time.monotonic()))

    def _leave(self, player) -> None:
        player.close()
        with self._there:
            self._players = [other for other in self._players if other is not player]


def _turn(player) -> bool:
    try:
        return player.turn()
    except Exception:  # a fault in one voice ends that voice, never the others
        logging.exception("a played voice broke down")
        return False


def serve_voices(control: Connection) -> None:
    """Take one connection per voice from ``control`` until it is closed. Says WARM once the kernels are there."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the server's affair; it closes ``control``
    with suppress(OSError, AttributeError):  # where it is allowed: what sounds comes before what is looked at
        os.setpriority(os.PRIO_PROCESS, 0, PRIORITY)
    from vfcore.gesture.voice import Voice
    from vfcore.params import Activation, Simulation
    from vocalis_server.live.player import Player

    sys.setswitchinterval(SWITCH_S)
    Voice(Simulation()).advance(Simulation(activation=Activation(ct=0.5), vowel="i"))
    stage = Stage()
    threading.Thread(target=stage.run, name="stage", daemon=True).start()
    control.send(WARM)
    while True:
        try:
            link = control.recv()
        except (EOFError, OSError):
            return
        threading.Thread(target=_prepare, args=(Player(link), stage), name="voice", daemon=True).start()


def _prepare(player, stage: Stage) -> None:
    if player.prepare():
        stage.enter(player)
    else:
        player.close()
