"""The designed study: which claims change with each choice that the paper leaves open.

One factor at a time around the defaults of the variant "paper", then pairs of the most promising choices, then a
designed set of changes of the posture, on maps of 11 × 11 cells. T1 is left out: only the time step changes the cost of
a run. Run it with `vocalis paper --study`.
"""

from collections.abc import Callable, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from itertools import combinations
from time import perf_counter
from typing import Any

from vfcore.spec.request import resolve
from vocalis.studies.paper.cases import Case, MuscleAxis, evenly
from vocalis.studies.paper.claims.claim import Verdict
from vocalis.studies.paper.claims.registry import CLAIMS
from vocalis.studies.paper.run.document import plain_outcome, provenance
from vocalis.studies.paper.run.gather import gather, warm_up
from vocalis.studies.paper.run.score import cases_for, judge, score
from vocalis.studies.paper.study.choices import CHOICES, DEFAULT, DESIGNED, Choice, both

COARSE = evenly(10)
#: How many choices, each of a different factor, are tried in pairs.
PAIRED = 4
_POINTS = {Verdict.PASS: 2, Verdict.DEVIATION: 1, Verdict.FAIL: 0}
#: All claims except the cost of a run.
PHYSICS = {key: claim for key, claim in CLAIMS.items() if key != "T1"}
Watch = Callable[[str], Callable[[str, int, int], None]]


def study_document(
    pool: ProcessPoolExecutor, watched: Watch = lambda name: lambda case, done, total: None
) -> dict[str, Any]:
    """Run the study: the outcome of every claim for every choice, the default first, pairs last."""
    began = perf_counter()
    rows = [_tried(choice, pool, watched) for choice in (DEFAULT, *CHOICES)]
    paired = [both(first, second) for first, second in combinations(promising(rows), 2)]
    rows += [_tried(choice, pool, watched) for choice in (*paired, *DESIGNED) if choice not in CHOICES]
    return {
        "kind": "study",
        "provenance": provenance(),
        "seconds": round(perf_counter() - began, 1),
        "rows": [row for _, row in rows],
    }


def promising(rows: list[tuple[Choice, dict[str, Any]]]) -> list[Choice]:
    """The best choice of each factor that changes a verdict, the PAIRED best of them.

    Pass counts 2 points, deviation 1.
    """
    default = rows[0][1]
    best: dict[str, tuple[int, Choice]] = {}
    for choice, row in rows[1:]:
        if choice.control or not changes(row, default):
            continue
        points = sum(_POINTS[Verdict(one["verdict"])] for one in row["outcomes"].values())
        if choice.factor not in best or points > best[choice.factor][0]:
            best[choice.factor] = points, choice
    ranked = sorted(best.values(), key=lambda entry: -entry[0])
    return [choice for _, choice in ranked[:PAIRED]]


def changes(row: Mapping[str, Any], default: Mapping[str, Any]) -> list[tuple[str, str, str]]:
    """(claim, default verdict, verdict of the row) of the claims whose verdict differs."""
    pairs = ((key, one["verdict"], row["outcomes"][key]["verdict"]) for key, one in default["outcomes"].items())
    return [(key, was, now) for key, was, now in pairs if was != now]


def _tried(choice: Choice, pool: ProcessPoolExecutor, watched: Watch) -> tuple[Choice, dict[str, Any]]:
    base = resolve(choice.change)
    warm_up(base)
    cases = {key: coarse(case) for key, case in cases_for(base, PHYSICS).items()}
    gathered = gather(cases, pool, watched(choice.name), choice.level, choice.fold)
    outcomes = judge(gathered.evidence, PHYSICS)
    row = {
        "choice": choice.name,
        "change": choice.change,
        "score": score(outcomes),
        "outcomes": {key: plain_outcome(outcome) for key, outcome in outcomes.items()},
        "failed_runs": len(gathered.failures),
    }
    return choice, row


def coarse(case: Case) -> Case:
    """The case with a map of 11 × 11 cells; curves and shapes unchanged."""
    if case.kind != "map":
        return case
    return replace(case, axes=tuple(MuscleAxis(axis.muscles, COARSE) for axis in case.axes))
