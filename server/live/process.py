"""The process in which voices are played: one thread each, kernels compiled once."""

import signal
import threading
from multiprocessing.connection import Connection

WARM = "warm"


def serve_voices(control: Connection) -> None:
    """Take one connection per voice from ``control`` until it is closed. Says WARM once the kernels are there."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the server's affair; it closes ``control``
    from vfcore.gesture.voice import Voice
    from vfcore.params import Simulation
    from vocalis_server.live.player import Player

    Voice(Simulation()).advance(Simulation(vowel="i"))
    control.send(WARM)
    while True:
        try:
            link = control.recv()
        except (EOFError, OSError):
            return
        threading.Thread(target=_play, args=(Player, link), name="voice", daemon=True).start()


def _play(player, link: Connection) -> None:
    try:
        player(link).run()
    finally:
        link.close()
