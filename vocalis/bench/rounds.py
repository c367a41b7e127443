"""Timing of several things fairly: one after the other, round after round, so that all see the same machine.

A short task is called again and again within its turn: a single call after another task would time how cold the caches
are and how soon the processor wakes.
"""

import time
from collections.abc import Callable, Mapping
from statistics import median

TURN_S = 0.1  # at least so long is each task's turn in a round


def interleaved(tasks: Mapping[str, Callable[[], object]], rounds: int, turn_s: float = TURN_S) -> dict[str, float]:
    """Median over ``rounds`` rounds of the seconds of one call of each task: the median of ``turns``."""
    return {name: median(values) for name, values in turns(tasks, rounds, turn_s).items()}


def turns(tasks: Mapping[str, Callable[[], object]], rounds: int, turn_s: float = TURN_S) -> dict[str, list[float]]:
    """Seconds of one call of each task in each of ``rounds`` rounds, after a round that does not count; each has turns
    of at least ``turn_s``, of which the mean over its calls is taken."""
    seconds: dict[str, list[float]] = {name: [] for name in tasks}
    for lap in range(rounds + 1):
        for name, task in tasks.items():
            took = _turn(task, turn_s)
            if lap > 0:
                seconds[name].append(took)
    return seconds


def _turn(task: Callable[[], object], turn_s: float) -> float:
    """Mean seconds of a call over at least ``turn_s``."""
    calls, began = 0, time.perf_counter()
    while True:
        task()
        calls += 1
        passed = time.perf_counter() - began
        if passed >= turn_s:
            return passed / calls
