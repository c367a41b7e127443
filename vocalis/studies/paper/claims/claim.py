"""A claim of the paper, and what comes of checking it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, NamedTuple

#: How a claim is best shown beside its verdict.
PICTURES = ("static_shapes", "waveforms", "cycle", "map", "curve", "number")


class Verdict(StrEnum):
    """``pass``: as the paper says. ``deviation``: its sense holds, with a stated difference. ``fail``: neither."""

    PASS = "pass"
    DEVIATION = "deviation"
    FAIL = "fail"


class Measured(NamedTuple):
    """One number (or word) behind a verdict; ``value`` is None where the runs give none."""

    name: str
    value: float | str | None
    unit: str


@dataclass(frozen=True, slots=True)
class Outcome:
    """``sentence``: what was found; for a deviation or a failure, only what differs from the paper."""

    verdict: Verdict
    measured: tuple[Measured, ...]
    sentence: str


@dataclass(frozen=True, slots=True)
class Claim:
    """One claim.

    ``paper_says``: in our words, with the place in the paper. ``definition``: the test in words and numbers.
    ``check``: a pure function of the evidence of the cases in ``needs``, in that order. ``picture``: one of PICTURES.
    """

    key: str
    title: str
    paper_says: str
    definition: str
    check: Callable[..., Outcome]
    needs: tuple[str, ...]
    picture: str

    def judge(self, evidence: Mapping[str, Any]) -> Outcome:
        """The outcome, given the evidence by case. Raises KeyError for a case that is not there."""
        return self.check(*(evidence[case] for case in self.needs))
