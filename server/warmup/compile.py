"""Compiles every kernel of the usual grid into the cache, once: for ``--warm``, and in the background of a server.

A server first compiles what the page needs (state.py). The kernels of maps, live voices and coupled runs take as long
again. A process of low priority compiles them, so that neither requests nor the first map wait for compilation.
"""

import os
import signal
from contextlib import suppress
from multiprocessing import get_context
from multiprocessing.process import BaseProcess

from vfcore.kernels.jit import kernel_directory
from vfcore.runs.gesture.voice import Voice
from vfcore.runs.one import simulate
from vfcore.spec.simulation import Simulation
from vocalis.server.warmup.live import warm_up_voice
from vocalis.server.warmup.requests import COUPLED, IRREGULAR, PERIODIC, warm_up_points

_COMPLETE = "complete"  # a file in the folder of the kernels: all are compiled
_NICENESS = 10


def compile_everything() -> None:
    """Compile or load: single and coupled runs, live voices, gestures, sweeps in both precisions."""
    for request in (PERIODIC, IRREGULAR, COUPLED):
        simulate(request)
    warm_up_voice()
    Voice(Simulation()).advance(Simulation(vowel="i"))  # a gesture: with the sound at 0.3 m
    warm_up_points()
    with suppress(OSError):  # a folder without write permission
        (kernel_directory() / _COMPLETE).touch()


def compile_in_background() -> BaseProcess | None:
    """A process that compiles everything; None where all is compiled."""
    if (kernel_directory() / _COMPLETE).exists():
        return None
    process = get_context("spawn").Process(target=_compile_niced, name="vocalis-compile", daemon=True)
    process.start()
    return process


def _compile_niced() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the server handles Ctrl-C, and ends this process
    os.nice(_NICENESS)
    compile_everything()
