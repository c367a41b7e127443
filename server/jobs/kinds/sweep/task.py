"""One task of a sweep: computed in one executor slot, stored, and tried again point by point where its worker died."""

from typing import TYPE_CHECKING, Any

from vfcore.runs.sweep.plan import Sweep
from vfcore.version import MODEL_VERSION
from vocalis.server.jobs.computations import run_part_of_sweep
from vocalis.server.jobs.executor_slot import Call, Died, ExecutorSlot, Failed, Finished, NoConnection
from vocalis.server.problems import is_about_model

if TYPE_CHECKING:
    from vocalis.server.jobs.kinds.sweep.work import SweepWork

RECONNECT_S = 1.0


class _WrongModel(Exception):
    """Carries the problem that ends the sweep."""


class SweepTask:
    """Points of a sweep that one worker computes in one go."""

    def __init__(self, work: "SweepWork", positions: list[int], addresses: list[str]):
        self.work, self.positions, self.addresses = work, positions, addresses

    @property
    def part(self) -> Sweep:
        """The sweep of these points only."""
        return self.work.sweep.part(self.positions)

    def run(self, slot: ExecutorSlot) -> dict[str, Any] | None:
        """After the death of its worker the points run one by one, so that at most one is lost."""
        try:
            if self._attempt(slot) is None:
                return None
            for single in self._singles():
                if self.work.stop.is_set():
                    return None
                if (died := single._attempt(slot)) is not None:
                    problem = f"The worker process ended while it computed this point, with exit code {died.exit_code}."
                    self.work.gave_up(single, problem)
        except _WrongModel as error:
            return error.args[0]
        return None

    def close(self) -> None:
        self.work.close_task(self)

    def _singles(self) -> "list[SweepTask]":
        """The same points, one task each."""
        pairs = zip(self.positions, self.addresses, strict=True)
        return [SweepTask(self.work, [position], [address]) for position, address in pairs]

    def _attempt(self, slot: ExecutorSlot) -> Died | None:
        """One try; Died when the worker did, None when the task needs no other."""
        work = self.work
        call = Call(run_part_of_sweep, (self.part, MODEL_VERSION), tuple(self.addresses))
        while not work.stop.is_set():
            try:
                outcome = slot.run(call, lambda _: None, work.stop)
            except NoConnection:  # nothing was computed: this is no attempt
                work.stop.wait(RECONNECT_S)
                continue
            if isinstance(outcome, Finished):
                work.keep_results(self, outcome.result.results)
                work.computed(self, outcome.result.rows)
                work.portions.learn(len(self.positions), outcome.result.seconds)
            elif isinstance(outcome, Failed) and is_about_model(outcome.problem):
                raise _WrongModel(outcome.problem)
            elif isinstance(outcome, Failed):
                work.gave_up(self, outcome.problem["detail"])
            elif isinstance(outcome, Died):
                return outcome
            break
        return None
