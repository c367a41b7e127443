"""Interleaved timing: tasks run one after the other, round after round, so all see the same state of the machine.

Within its turn a short task is called repeatedly. A single call would mostly time cold caches and the wake-up of the
processor.
"""

import time
from collections.abc import Callable, Hashable, Mapping
from statistics import median
from typing import TypeVar

TURN_S = 0.1  # minimum length of the turn of a task in a round

Name = TypeVar("Name", bound=Hashable)


def interleaved(tasks: Mapping[Name, Callable[[], object]], rounds: int, turn_s: float = TURN_S) -> dict[Name, float]:
    """Seconds per call of each task, median over ``rounds`` rounds."""
    return {name: median(values) for name, values in turns(tasks, rounds, turn_s).items()}


def turns(
    tasks: Mapping[Name, Callable[[], object]],
    rounds: int,
    turn_s: float = TURN_S,
    clock: Callable[[], float] = time.perf_counter,
) -> dict[Name, list[float]]:
    """Seconds per call of each task in each of ``rounds`` rounds, after one round of warm-up.

    Each number is the mean over the calls of a turn of at least ``turn_s``. ``clock``: ``time.thread_time`` does not
    count the time in which another program had the core.
    """
    seconds: dict[Name, list[float]] = {name: [] for name in tasks}
    for lap in range(rounds + 1):
        for name, task in tasks.items():
            took = _turn(task, turn_s, clock)
            if lap > 0:
                seconds[name].append(took)
    return seconds


def _turn(task: Callable[[], object], turn_s: float, clock: Callable[[], float]) -> float:
    """Mean seconds per call over at least ``turn_s``."""
    calls, began = 0, clock()
    while True:
        task()
        calls += 1
        passed = clock() - began
        if passed >= turn_s:
            return passed / calls
