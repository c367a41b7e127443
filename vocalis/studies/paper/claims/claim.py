"""A claim of the paper, and its outcome."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, NamedTuple

#: The kinds of pictures that show a claim.
PICTURES = ("static_shapes", "waveforms", "cycle", "map", "curve", "number")


class Verdict(StrEnum):
    """``pass``: as the paper says. ``deviation``: true in substance, with a stated difference. ``fail``: neither."""

    PASS = "pass"
    DEVIATION = "deviation"
    FAIL = "fail"


class Measured(NamedTuple):
    """One number (or word) behind a verdict; ``value`` is None if the runs have none."""

    name: str
    value: float | str | None
    unit: str


@dataclass(frozen=True, slots=True)
class ClaimOutcome:
    """The verdict on a claim, its numbers, and a sentence: the findings, or for a deviation or failure the
    differences.
    """

    verdict: Verdict
    measured: tuple[Measured, ...]
    sentence: str


@dataclass(frozen=True, slots=True)
class Claim:
    """One claim.

    ``paper_says``: the claim in our words, with its place in the paper. ``definition``: the test in words and numbers.
    ``check``: a pure function of the evidence of the cases in ``needs``, in that order. ``picture``: one of PICTURES.
    """

    key: str
    title: str
    paper_says: str
    definition: str
    check: Callable[..., ClaimOutcome]
    needs: tuple[str, ...]
    picture: str

    def judge(self, evidence: Mapping[str, Any]) -> ClaimOutcome:
        """The outcome, from the evidence by case; KeyError for a missing case."""
        return self.check(*(evidence[case] for case in self.needs))
