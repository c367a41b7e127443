"""Every kernel of the usual grid, compiled into the cache once: by ``--warm``, and behind a server that has started.

A server compiles what the page needs first by itself (state.py). What only maps, played voices and coupled runs need
takes as long again; a process of low priority does it, so that neither answers wait for it nor the first map of a user.
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
from vocalis.server.warmup.live import rehearse
from vocalis.server.warmup.requests import COUPLED, IRREGULAR, PERIODIC, warm_up_points

_COMPLETE = "complete"  # the file that says so, beside the kernels
_NICENESS = 10


def compile_everything() -> None:
    """Compile, or load: runs alone and coupled, played voices, many side by side in both precisions."""
    for request in (PERIODIC, IRREGULAR, COUPLED):
        simulate(request)
    rehearse()
    Voice(Simulation()).advance(Simulation(vowel="i"))  # a gesture: with the sound at 0.3 m
    warm_up_points()
    with suppress(OSError):  # a folder that others own
        (kernel_directory() / _COMPLETE).touch()


def compile_behind() -> BaseProcess | None:
    """The process that compiles everything; None where all is there."""
    if (kernel_directory() / _COMPLETE).exists():
        return None
    process = get_context("spawn").Process(target=_compile_niced, name="vocalis-compile", daemon=True)
    process.start()
    return process


def _compile_niced() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the server's affair; it ends us
    os.nice(_NICENESS)
    compile_everything()
