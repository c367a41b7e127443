"""Compiling the kernels in the background, so that the page is there at once."""

import threading
import time

import vfcore
from vfcore.params import Run, Simulation
from vfcore.simulate import prepare, simulate

_SHORTEST = Run(duration_s=0.02)


class Kernels:
    """Whether the kernels are compiled, and what is going on, in words."""

    def __init__(self) -> None:
        self._ready = threading.Event()
        self.message = "kernels not compiled yet"

    def start(self) -> None:
        """Compile in a thread of its own."""
        threading.Thread(target=self.compile, name="compile", daemon=True).start()

    @property
    def ready(self) -> bool:
        return self._ready.is_set()

    def compile(self) -> None:
        """Compile, or load from the cache, what a default request needs."""
        began = time.perf_counter()
        try:
            self.message = "compiling the posture equations (1 of 2)"
            prepare(Simulation())
            self.message = "compiling the step of the fold (2 of 2)"
            simulate(Simulation(run=_SHORTEST))
        except Exception as error:
            self.message = f"compiling failed: {error}"
            raise
        self.message = f"ready: kernels of model {vfcore.MODEL_VERSION} in {time.perf_counter() - began:.1f} s"
        self._ready.set()
