"""Timing of several things fairly: one after the other, round after round, so that all see the same machine.

A short task is called again and again within its turn: a single call after another task would time how cold the caches
are and how soon the processor wakes.
"""

import time
from collections.abc import Callable, Mapping
from statistics import median

TURN_S = 0.1  # at least so long is each task's turn in a round


def interleaved(tasks: Mapping[str, Callable[[], object]], rounds: int) -> dict[str, float]:
    """Median over ``rounds`` rounds of the seconds of one call of each task, after a round that does not count."""
    seconds: dict[str, list[float]] = {name: [] for name in tasks}
    for lap in range(rounds + 1):
        for name, task in tasks.items():
            took = _turn(task)
            if lap > 0:
                seconds[name].append(took)
    return {name: median(values) for name, values in seconds.items()}


def _turn(task: Callable[[], object]) -> float:
    """Mean seconds of a call over at least TURN_S."""
    calls, began = 0, time.perf_counter()
    while True:
        task()
        calls += 1
        passed = time.perf_counter() - began
        if passed >= TURN_S:
            return passed / calls
