"""One task of a sweep in one lane: computed, stored, and tried again where its worker died."""

from typing import Any, Protocol

from vfcore.version import MODEL_VERSION
from vocalis.server.http.problems import is_about_model
from vocalis.server.jobs.executor_slot import Died, Failed, Finished, Lane, NoConnection
from vocalis.server.jobs.sweep_work import Keeper, Task

RECONNECT_S = 1.0


class SweepListener(Keeper, Protocol):
    """Who stores what tasks give."""

    def keep_results(self, task: Task, results: dict[int, Any]) -> None: ...


class _WrongModel(Exception):
    """Carries the problem that ends the sweep."""


def carry_out(lane: Lane, task: Task, listener: SweepListener) -> dict[str, Any] | None:
    """Have a task computed and stored; after the death of its worker point by point, so that one is lost at most.

    Returns the problem that ends the whole sweep, None when there is none.
    """
    try:
        if (died := _attempt(lane, task, listener)) is None:
            return None
        for single in task.singles():
            if task.work.stop.is_set():
                return None
            if (died := _attempt(lane, single, listener)) is not None:
                listener.gave_up(
                    single, f"The worker process ended while it computed this point, with exit code {died.exit_code}."
                )
    except _WrongModel as error:
        return error.args[0]
    return None


def _attempt(lane: Lane, task: Task, listener: SweepListener) -> Died | None:
    """One try; Died when the worker did, None when the task needs no other."""
    sweep = task.work
    while not sweep.stop.is_set():
        try:
            outcome = lane.run("sweep", (task.part, MODEL_VERSION), lambda _: None, sweep.stop)
        except NoConnection:  # nothing was computed: this is no attempt
            sweep.stop.wait(RECONNECT_S)
            continue
        if isinstance(outcome, Finished):
            listener.keep_results(task, outcome.result.results)
            listener.computed(task, outcome.result.rows)
            sweep.portions.learn(len(task.positions), outcome.result.seconds)
        elif isinstance(outcome, Failed) and is_about_model(outcome.problem):
            raise _WrongModel(outcome.problem)
        elif isinstance(outcome, Failed):
            listener.gave_up(task, outcome.problem["detail"])
        elif isinstance(outcome, Died):
            return outcome
        break
    return None
