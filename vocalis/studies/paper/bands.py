"""Bands of a number for pass, deviation and fail; the verdict of a claim is that of its worst part.

A part without a number (NaN) fails. Bounds are inclusive, up to rounding.
"""

import math
from typing import NamedTuple

from vocalis.studies.paper.claims.claim import ClaimOutcome, Measured, Verdict

PASS, DEVIATION, FAIL = Verdict.PASS, Verdict.DEVIATION, Verdict.FAIL
ROUNDING = 1e-9
_ORDER = (PASS, DEVIATION, FAIL)


class Part(NamedTuple):
    """One requirement of a claim: its number, the finding as a clause, and its verdict."""

    name: str
    value: float | str
    unit: str
    says: str
    verdict: Verdict


def at_least(value: float, good: float, fair: float) -> Verdict:
    """Pass from ``good`` up, deviation from ``fair`` up."""
    return PASS if value >= good - ROUNDING else DEVIATION if value >= fair - ROUNDING else FAIL


def at_most(value: float, good: float, fair: float) -> Verdict:
    """Pass up to ``good``, deviation up to ``fair``."""
    return PASS if value <= good + ROUNDING else DEVIATION if value <= fair + ROUNDING else FAIL


def above(value: float, good: float, fair: float) -> Verdict:
    """Pass strictly above ``good``, deviation strictly above ``fair``."""
    return PASS if value > good else DEVIATION if value > fair else FAIL


def below(value: float, good: float, fair: float) -> Verdict:
    """Pass strictly below ``good``, deviation strictly below ``fair``."""
    return PASS if value < good else DEVIATION if value < fair else FAIL


def between(value: float, good: tuple[float, float], fair: tuple[float, float]) -> Verdict:
    """Pass within ``good``, deviation within ``fair``, both closed."""
    return worst(at_least(value, good[0], fair[0]), at_most(value, good[1], fair[1]))


def worst(*verdicts: Verdict) -> Verdict:
    """The worst of the verdicts."""
    return max(verdicts, key=_ORDER.index)


def conclude(*parts: Part) -> ClaimOutcome:
    """The outcome of a claim. The sentence names all parts if all pass, otherwise only those that do not."""
    verdict = worst(*(part.verdict for part in parts))
    clauses = [_clause(part) for part in parts if verdict is PASS or part.verdict is not PASS]
    sentence = "; ".join(clauses)
    if not sentence.startswith("f_o"):  # a symbol keeps its case
        sentence = sentence[:1].upper() + sentence[1:]
    return ClaimOutcome(verdict, tuple(_measured(part) for part in parts), f"{sentence}.")


def _clause(part: Part) -> str:
    return f"{part.name}: no value" if _is_missing(part) else part.says


def _measured(part: Part) -> Measured:
    if _is_missing(part):
        return Measured(part.name, None, part.unit)
    return Measured(part.name, part.value if isinstance(part.value, str) else float(part.value), part.unit)


def _is_missing(part: Part) -> bool:
    return not isinstance(part.value, str) and not math.isfinite(part.value)
