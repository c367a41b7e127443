"""Compiles the kernels in the background, so that the page is available at once."""

import asyncio
import logging
import threading
import time
from collections.abc import Callable
from multiprocessing.process import BaseProcess

from vfcore.runs.one import simulate
from vfcore.runs.setup import prepare
from vfcore.version import MODEL_VERSION
from vocalis.server.exceptions import NotReady
from vocalis.server.warmup.compile import (
    compile_everything,
    compile_forms,
    everything_is_compiled,
    forms_are_compiled,
    in_background,
    load_forms,
)
from vocalis.server.warmup.requests import COUPLED, IRREGULAR, PERIODIC

log = logging.getLogger("vocalis")
WAIT_S = 30.0  # for a first compilation on a slow machine
LOOK_EVERY_S = 0.02


class Kernels:
    """Which kernels are compiled, with a message for people."""

    def __init__(self, further_forms: bool = True) -> None:
        self._further_forms = further_forms
        self._postures, self._runs = threading.Event(), threading.Event()
        self._failed = self._closed = False
        self._background: BaseProcess | None = None
        self.message = "the kernels are not compiled yet"

    @property
    def ready(self) -> bool:
        """Whether everything a default request needs is compiled."""
        return self._runs.is_set()

    def start(self, then: Callable[[], None] = lambda: None) -> None:
        """Compile in a thread, and the less urgent kernels in processes: first those of maps and live voices, after
        which the thread calls ``then``, and then, unless the server shall not, further forms of the step.
        """
        threading.Thread(target=self._compile_all, args=(then,), name="compile", daemon=True).start()

    def close(self) -> None:
        """End the process that compiles less urgent kernels."""
        self._closed = True
        if self._background is not None:
            self._background.kill()

    def compile(self) -> None:
        """Compile, or load from the cache, what a default request needs."""
        began = time.perf_counter()
        try:
            self.message = "compiling the posture equations (1 of 2)"
            prepare(PERIODIC)
            self._postures.set()
            self.message = "compiling the step of the fold (2 of 2)"
            for request in (PERIODIC, IRREGULAR):
                simulate(request)
        except Exception as error:
            self._failed = True
            self.message = f"the kernels could not be compiled: {error}"
            log.exception("compiling failed")
            return
        self.message = f"ready: the kernels of model {MODEL_VERSION} took {time.perf_counter() - began:.1f} s"
        self._runs.set()

    def _compile_all(self, then: Callable[[], None]) -> None:
        self.compile()
        if self._failed or self._closed:
            return
        if not everything_is_compiled():
            self._wait_for(compile_everything)
        if self._closed:
            return
        then()
        simulate(COUPLED)  # loads its kernels, so that the first coupled run does not wait for that
        if self._closed or not self._further_forms:
            return
        if not forms_are_compiled():
            self._wait_for(compile_forms)
        if not self._closed:
            load_forms()

    def _wait_for(self, compiles: Callable[[], None]) -> None:
        """Compile in another process, and return when it has ended."""
        self._background = in_background(compiles)
        self._background.join()

    async def for_postures(self) -> None:
        """Return when postures can be solved; NotReady when that takes too long or has failed."""
        await self._wait(self._postures)

    async def for_runs(self) -> None:
        """Return when runs can be made; NotReady as above."""
        await self._wait(self._runs)

    async def _wait(self, compiled: threading.Event) -> None:
        deadline = time.monotonic() + WAIT_S
        while not compiled.is_set():
            if self._failed or time.monotonic() > deadline:
                raise NotReady(f"Not ready: {self.message}.")
            await asyncio.sleep(LOOK_EVERY_S)
