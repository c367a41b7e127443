"""The study that finds the constants of ``human``: a search from a seed, and a rule that says which set is adopted.

The search starts from a Latin hypercube over constants and posture and evolves it by how far each set is from what is
wanted (vocalis_norms.shortfall). Its best sets are then judged in full: every norm, and every claim of the paper on
full maps with runs of 1 s, beside the paper's constants with either coupling. Adopted is the first by ``rank``:

1. the wanted norms met, twelve of fifteen;
2. the fewest claims on shapes, closure patterns and maps that come out worse than with the paper's constants, two-way
   coupled too;
3. the most of these that come out no worse than with the paper's constants and one-way coupling;
4. the most norms; of equals the smallest sum of what the norms are missed by.

The claims on one cycle (M) and on PCA (P) are judged, and count in the search, not in the rule. Run it with
`vocalis norms --study`.
"""

import itertools
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from math import log
from typing import Any, NamedTuple

import numpy as np
from scipy.stats import spearmanr

from vfcore.params import Simulation
from vfcore.request import simulation_from_dict
from vocalis_norms.evolution import Generation, evolve
from vocalis_norms.factors import (
    CONSTANTS,
    FACTORS,
    POSTURE,
    Values,
    activation_of,
    base_of,
    constants_of,
    sample,
    values_at,
)
from vocalis_norms.norms import FIFTEEN
from vocalis_norms.score import judged, score_base
from vocalis_norms.shortfall import AIMS, RANK, TRENDS, WANTED, Tried, distances, shortfall, voices
from vocalis_paper.bands import FAIL, PASS
from vocalis_paper.run import gather, warm_up
from vocalis_paper.run_document import provenance
from vocalis_paper.run_score import cases_for, judge
from vocalis_paper.study import PHYSICS

SEED = 20261126
#: Each round: how many of the best sets go on, for how many generations, and how long the paper's voices run, s. What
#: the first takes is a Latin hypercube; the second reads these voices as they are judged in the end.
ROUNDS = ((40, 11, 0.5), (24, 11, 1.0))
#: How many of the best sets are judged in full, and in how many other postures, the same for all, the norms are read
#: before: a norm fixes no muscles.
FINALISTS, POSTURES = 9, 16
#: Claims on shapes and closure patterns (S) and on the maps over CT and TA (A), which the voice must keep.
HELD = tuple(key for key in TRENDS if key[0] in "SA")
Progress = Callable[[int, int], None]
Verdicts = Mapping[str, str]


class Reference(NamedTuple):
    """The verdicts of the paper's constants with either coupling, by claim."""

    one_way: Verdicts
    two_way: Verdicts


class Candidate(NamedTuple):
    """A set judged in full: its factors, the judged norms, how far those out of range are, and the claims' verdicts."""

    values: Values
    judged: dict[str, Any]
    distance: float
    claims: Verdicts
    reference: Reference

    @property
    def in_range(self) -> int:
        return self.judged["in_range"]

    @property
    def lost(self) -> list[str]:
        """Claims to be held that come out worse than with the paper's constants, both two-way coupled."""
        return [key for key in HELD if RANK[self.claims[key]] > RANK[self.reference.two_way[key]]]

    @property
    def kept(self) -> list[str]:
        """Claims to be held that come out no worse than with the paper's constants, one-way coupled."""
        return [key for key in HELD if RANK[self.claims[key]] <= RANK[self.reference.one_way[key]]]

    @property
    def rank(self) -> tuple[float, ...]:
        """The rule, smallest first."""
        return max(WANTED - self.in_range, 0), len(self.lost), -len(self.kept), -self.in_range, self.distance

    @property
    def merits(self) -> tuple[int, int, int]:
        return self.in_range, -len(self.lost), len(self.kept)

    def beats(self, other: "Candidate") -> bool:
        """Whether it is as good in norms, claims lost and claims kept, and better in one of them."""
        return self.merits != other.merits and all(a >= b for a, b in zip(self.merits, other.merits, strict=True))


def study_document(
    pool: ProcessPoolExecutor,
    progress: Progress = lambda done, total: None,
    rounds: Sequence[tuple[int, int, float]] = ROUNDS,
    finalists: int = FINALISTS,
) -> dict[str, Any]:
    """Run the study: the sets judged in full, those that no other beats, and how the constants move the numbers."""
    trials = sum(size * (generations + 1) for size, generations, _ in rounds)
    ticks = itertools.count(1)

    def count() -> None:
        progress(next(ticks), trials + finalists)

    reference = Reference(*(_verdicts(_paper(way), pool) for way in ("one_way", "two_way")))
    allowed = {key: RANK[verdict] for key, verdict in reference.two_way.items()}

    def attempt(voice_s: float, points: Sequence[np.ndarray], bars: Sequence[float]) -> list[Tried]:
        found = []
        for one in pool.map(partial(shortfall, allowed, voice_s), points, bars):
            found.append(one)
            count()
        return found

    found: list[Generation] = []
    for number, (size, generations, voice_s) in enumerate(rounds):
        points = _leading(found[-1], size) if found else sample(size, SEED)
        found += evolve(points, partial(attempt, voice_s), generations, SEED + number)
    ranked = []
    for values in best_of(found[-1].points, found[-1].tried, finalists):
        ranked.append(_in_full(values, reference, pool))
        count()
    ranked.sort(key=lambda candidate: candidate.rank)
    return {
        "kind": "calibration",
        "provenance": provenance(),
        "factors": [{"name": f.name, "unit": f.unit, "low": f.low, "high": f.high} for f in FACTORS],
        "reference": reference._asdict(),
        "tried": trials,
        "shortfall": [round(min(one.total for one in generation.tried), 2) for generation in found],
        "best": [_plain(candidate) for candidate in ranked],
        "front": [_plain(candidate) for candidate in front(ranked)],
        "effects": _effects(found[0].points, found[0].tried),
    }


def _leading(generation: Generation, size: int) -> np.ndarray:
    """The points of the ``size`` best sets."""
    return generation.points[np.argsort([one.total for one in generation.tried], kind="stable")[:size]]


def best_of(points: np.ndarray, tried: Sequence[Tried], count: int) -> list[Values]:
    """The factors of the ``count`` best points that differ after rounding, the best first."""
    kept: dict[tuple, Values] = {}
    for k in np.argsort([one.total for one in tried], kind="stable"):
        values = values_at(points[k])
        kept.setdefault((*constants_of(values).values(), *activation_of(values).values()), values)
    return list(kept.values())[:count]


def front(found: Iterable[Candidate]) -> list[Candidate]:
    """The candidates that none beats in norms and claims at once, most norms first; of equals the first."""
    everyone = list(found)
    kept: dict[tuple, Candidate] = {}
    for candidate in everyone:
        if not any(other.beats(candidate) for other in everyone):
            kept.setdefault(candidate.merits, candidate)
    return [kept[key] for key in sorted(kept, reverse=True)]


def _paper(way: str) -> Simulation:
    return simulation_from_dict({"model": {"coupling": way}})


def _verdicts(base: Simulation, pool: ProcessPoolExecutor) -> Verdicts:
    warm_up(base)
    outcomes = judge(gather(cases_for(base, PHYSICS), pool).evidence, PHYSICS)
    return {key: str(outcome.verdict) for key, outcome in outcomes.items()}


def by_norms(values: Values) -> tuple[int, float]:
    """Smallest first: how a set does by the norms alone, in a worker."""
    result = judged(voices(base_of(values)))
    return -result["in_range"], sum(distances(result["norms"]).values())


def _in_best_posture(values: Values, pool: ProcessPoolExecutor) -> Values:
    """The set in its own posture, or in another where it meets more norms."""
    names = [f.name for f in POSTURE]
    others = [values | {name: at[name] for name in names} for at in map(values_at, sample(POSTURES, SEED))]
    asked = [values, *others]
    ranks = list(pool.map(by_norms, asked))
    return asked[min(range(len(asked)), key=ranks.__getitem__)]


def _in_full(values: Values, reference: Reference, pool: ProcessPoolExecutor) -> Candidate:
    values = _in_best_posture(values, pool)
    base = base_of(values)
    result = score_base(base, pool)
    return Candidate(values, result, sum(distances(result["norms"]).values()), _verdicts(base, pool), reference)


def _effects(points: np.ndarray, tried: Sequence[Tried]) -> dict[str, dict[str, float]]:
    """Over the first generation, in which every set is run to the end."""
    sets = [values_at(point) for point in points]
    table = {key: _correlations(sets, [one.values.get(key) for one in tried]) for key in FIFTEEN}
    for key in AIMS:
        table[f"{key}: {AIMS[key].part}"] = _correlations(sets, [one.numbers.get(key) for one in tried])
    return table | {"shortfall": _correlations(sets, [one.total for one in tried])}


def _correlations(sets: Sequence[Values], numbers: Sequence[float | None]) -> dict[str, float]:
    """Rank correlation of a number with each constant."""
    known = [(values, number) for values, number in zip(sets, numbers, strict=True) if number is not None]
    known = [(values, number) for values, number in known if np.isfinite(number)]
    column = [number for _, number in known]
    if len(set(column)) < 2:  # what never moves goes with nothing
        return dict.fromkeys((f.name for f in CONSTANTS), 0.0)
    return {
        f.name: round(float(spearmanr([log(values[f.name]) for values, _ in known], column).statistic), 2)
        for f in CONSTANTS
    }


def _plain(candidate: Candidate) -> dict[str, Any]:
    counts = {str(verdict): sum(found == verdict for found in candidate.claims.values()) for verdict in RANK}
    return {
        "constants": constants_of(candidate.values),
        "activation": activation_of(candidate.values),
        "in_range": candidate.in_range,
        "distance": round(candidate.distance, 3),
        "norms": {key: candidate.judged["norms"][key]["value"] for key in FIFTEEN},
        "score": counts,
        "lost": candidate.lost,
        "kept": len(candidate.kept),
        "failed": [key for key, verdict in candidate.claims.items() if verdict == FAIL],
        "short": [key for key, verdict in candidate.claims.items() if verdict not in (FAIL, PASS)],
    }
