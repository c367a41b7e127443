"""Compiles every kernel of the usual grid into the cache, once: for ``--warm``, and in the background of a server.

A server first compiles what the page needs (state.py). The kernels of maps, live voices and coupled runs take as long
again. A process of low priority compiles them, so that neither requests nor the first map wait for compilation, and
another one then compiles the forms of the step for two folds, lesions and the human variant.
"""

import os
import signal
from collections.abc import Callable
from contextlib import suppress
from multiprocessing import get_context
from multiprocessing.process import BaseProcess

from vfcore.kernels.jit import kernel_directory
from vfcore.runs.gesture import forms
from vfcore.runs.gesture.voice import Voice
from vfcore.runs.one import simulate
from vfcore.spec.simulation import Simulation
from vocalis.server.warmup.live import warm_up_voice
from vocalis.server.warmup.requests import COUPLED, FORMS_AHEAD, HUMAN, IRREGULAR, OF_MAPS, PERIODIC, warm_up_points

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


def load_forms() -> None:
    """Compile or load the further forms of the step that users meet first, each once."""
    for request in FORMS_AHEAD:
        forms.load(forms.form_of(request))


def compile_forms() -> None:
    """Compile or load these forms, and maps of the human variant."""
    load_forms()
    warm_up_points([HUMAN])
    for form in OF_MAPS:
        forms.load(form)  # which also marks it as compiled


def everything_is_compiled() -> bool:
    """Whether ``compile_everything`` would only load."""
    return (kernel_directory() / _COMPLETE).exists()


def forms_are_compiled() -> bool:
    """Whether ``compile_forms`` would only load."""
    return all(map(forms.is_compiled, (*map(forms.form_of, FORMS_AHEAD), *OF_MAPS)))


def in_background(compiles: Callable[[], None]) -> BaseProcess:
    """A process of low priority, already started, that calls one of the functions above."""
    process = get_context("spawn").Process(target=_niced, args=(compiles,), name="vocalis-compile", daemon=True)
    process.start()
    return process


def _niced(compiles: Callable[[], None]) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the server handles Ctrl-C, and ends this process
    os.nice(_NICENESS)
    compiles()
