"""The calibration study of ``human``: a search for its constants, and the rule by which a set is adopted.

All sets are run with constant tension (stretch ``linear``); the variant itself has finite stretch.

The search starts from a Latin hypercube over constants and posture and minimises the shortfall of each set
(vocalis.studies.norms.shortfall) by differential evolution. Its best sets are then judged in full: every norm, and
every claim of the paper on full maps with runs of 1 s, compared with the paper's constants with either coupling. The
current set of ``human`` is judged as well: the search is sensitive to rounding, and only a better set should replace
the current one. The first set by ``rank`` is adopted:

1. at least twelve of the fifteen norms met;
2. the fewest claims on shapes, closure patterns and maps that are worse than with the paper's constants and two-way
   coupling;
3. the most of these claims that are no worse than with the paper's constants and one-way coupling;
4. the most norms; among equals, the smallest total distance from the norms.

The claims on one cycle (M) and on PCA (P) are judged and count in the search, but not in the rule. Run it with
`vocalis norms --study`.
"""

import itertools
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict
from functools import partial
from math import log
from typing import Any

import numpy as np
from scipy.stats import spearmanr

from vfcore.spec.request import resolve
from vfcore.spec.simulation import Simulation
from vocalis.studies.norms import efforts
from vocalis.studies.norms.candidate import Candidate, Reference, Verdicts, front
from vocalis.studies.norms.evolution import Generation, evolve
from vocalis.studies.norms.factors import (
    CONSTANTS,
    FACTORS,
    POSTURE,
    Values,
    activation_of,
    base_of,
    constants_of,
    request_of,
    sample,
    values_at,
)
from vocalis.studies.norms.norms import FIFTEEN
from vocalis.studies.norms.score import judged, score_base
from vocalis.studies.norms.shortfall import AIMS, RANK, Tried, distances, shortfall, voices
from vocalis.studies.paper.run.document import provenance
from vocalis.studies.paper.run.gather import gather, warm_up
from vocalis.studies.paper.run.score import cases_for, judge
from vocalis.studies.paper.study.designed import PHYSICS

SEED = 20261126
#: Each round: number of sets, number of generations, and duration of the paper's voices, s. The first round starts from
#: a Latin hypercube, the second from the best sets of the first, with the durations of the full judgement.
ROUNDS = ((40, 11, 0.5), (24, 11, 1.0))
#: How many of the best sets are judged in full. Before that, their norms are read in so many other postures, the same
#: for all, since a norm does not fix the muscles.
FINALISTS, POSTURES = 9, 16
Progress = Callable[[int, int], None]


def study_document(
    pool: ProcessPoolExecutor,
    progress: Progress = lambda done, total: None,
    rounds: Sequence[tuple[int, int, float]] = ROUNDS,
    finalists: int = FINALISTS,
) -> dict[str, Any]:
    """Run the study. Its document holds the sets judged in full, the Pareto front, and the effects of the constants."""
    trials = sum(size * (generations + 1) for size, generations, _ in rounds)
    ticks = itertools.count(1)

    def count() -> None:
        progress(next(ticks), trials + finalists + 1)

    reference = Reference(*(_verdicts(_paper(way), pool) for way in ("one_way", "two_way")))
    allowed = {key: RANK[verdict] for key, verdict in reference.two_way.items()}

    def attempt(voice_s: float, points: Iterable[np.ndarray], limits: Sequence[float]) -> list[Tried]:
        found = []
        for one in pool.map(partial(shortfall, allowed, voice_s), points, limits):
            found.append(one)
            count()
        return found

    found: list[Generation] = []
    for number, (size, generations, voice_s) in enumerate(rounds):
        points = _leading(found[-1], size) if found else sample(size, SEED)
        found += evolve(points, partial(attempt, voice_s), generations, SEED + number)
    ranked = []
    for values in best_of(found[-1].points, found[-1].tried, finalists):
        values = _in_best_posture(values, pool)
        ranked.append(_in_full(constants_of(values), activation_of(values), reference, pool))
        count()
    ranked.append(_in_full(*current_set(), reference, pool))
    count()
    ranked.sort(key=lambda candidate: candidate.rank)
    return {
        "kind": "calibration",
        "provenance": provenance(),
        "factors": [{"name": f.name, "unit": f.unit, "low": f.low, "high": f.high} for f in FACTORS],
        "reference": reference._asdict(),
        "tried": trials,
        "shortfall": [round(min(one.total for one in generation.tried), 2) for generation in found],
        "best": [candidate.plain for candidate in ranked],
        "front": [candidate.plain for candidate in front(ranked)],
        "effects": _effects(found[0].points, found[0].tried),
    }


def _leading(generation: Generation, size: int) -> np.ndarray:
    """The points of the ``size`` best sets."""
    return generation.points[np.argsort([one.total for one in generation.tried], kind="stable")[:size]]


def best_of(points: np.ndarray, tried: Sequence[Tried], count: int) -> list[Values]:
    """The factors of the ``count`` best points that differ after rounding, best first."""
    kept: dict[tuple, Values] = {}
    for k in np.argsort([one.total for one in tried], kind="stable"):
        values = values_at(points[k])
        kept.setdefault((*constants_of(values).values(), *activation_of(values).values()), values)
    return list(kept.values())[:count]


def _paper(way: str) -> Simulation:
    return resolve({"model": {"coupling": way}})


def _verdicts(base: Simulation, pool: ProcessPoolExecutor) -> Verdicts:
    warm_up(base)
    outcomes = judge(gather(cases_for(base, PHYSICS), pool).evidence, PHYSICS)
    return {key: str(outcome.verdict) for key, outcome in outcomes.items()}


def by_norms(values: Values) -> tuple[int, float]:
    """Sort key of a set by the norms alone, best first; runs in a worker."""
    result = judged(voices(base_of(values)))
    return -result["in_range"], sum(distances(result["norms"]).values())


def _in_best_posture(values: Values, pool: ProcessPoolExecutor) -> Values:
    """The set in its own posture, or in another one in which it meets more norms."""
    names = [f.name for f in POSTURE]
    others = [values | {name: at[name] for name in names} for at in map(values_at, sample(POSTURES, SEED))]
    asked = [values, *others]
    ranks = list(pool.map(by_norms, asked))
    return asked[min(range(len(asked)), key=ranks.__getitem__)]


def current_set() -> tuple[dict[str, float], dict[str, float]]:
    """Current constants of ``human`` and activation of its norms, with the names of ``constants_of``."""
    own = resolve({"model": {"variant": "human"}}).larynx
    names = constants_of(values_at([0.5] * len(FACTORS)))
    return {name: own.value(name) for name in names}, asdict(efforts.POSTURE)


def _in_full(
    constants: dict[str, float], activation: dict[str, float], reference: Reference, pool: ProcessPoolExecutor
) -> Candidate:
    base = request_of(constants, activation)
    result = score_base(base, pool)
    distance = sum(distances(result["norms"]).values())
    return Candidate(constants, activation, result, distance, _verdicts(base, pool), reference)


def _effects(points: np.ndarray, tried: Sequence[Tried]) -> dict[str, dict[str, float]]:
    """Rank correlations over the first generation, in which every set is run to the end."""
    sets = [values_at(point) for point in points]
    table = {key: _correlations(sets, [one.values.get(key) for one in tried]) for key in FIFTEEN}
    for key in AIMS:
        table[f"{key}: {AIMS[key].part}"] = _correlations(sets, [one.numbers.get(key) for one in tried])
    return table | {"shortfall": _correlations(sets, [one.total for one in tried])}


def _correlations(sets: Sequence[Values], numbers: Sequence[float | None]) -> dict[str, float]:
    """Rank correlation of a number with each constant; 0 if the number is constant."""
    known = [(values, number) for values, number in zip(sets, numbers, strict=True) if number is not None]
    known = [(values, number) for values, number in known if np.isfinite(number)]
    column = [number for _, number in known]
    if len(set(column)) < 2:
        return dict.fromkeys((f.name for f in CONSTANTS), 0.0)
    return {
        f.name: round(float(spearmanr([log(values[f.name]) for values, _ in known], column).statistic), 2)
        for f in CONSTANTS
    }
