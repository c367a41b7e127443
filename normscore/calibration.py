"""The designed study behind the variant ``human``: constants that meet published norms and keep the paper's trends.

A Latin hypercube over the constants that may change, then others in ever smaller boxes around the best candidate so
far; all with two-way coupling. A norm fixes no muscles: a candidate is judged by the norms in several postures and
stands with the best of them. Where it meets enough norms there, the paper's claims are judged as well, on coarse maps
and runs of half a second. Run it with `vocalis norms --study`. Ranges are those in which the constants have been
measured or used; see vfcore.variants.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from math import log, sqrt
from typing import Any, NamedTuple

from scipy.stats import qmc, spearmanr

from vfcore.constants import FoldConstants
from vfcore.params import Simulation
from vfcore.request import simulation_from_dict
from vocalis_norms.efforts import requests
from vocalis_norms.norms import FIFTEEN, NORMS
from vocalis_norms.score import answer, judged
from vocalis_paper.bands import FAIL, PASS
from vocalis_paper.run import gather, warm_up
from vocalis_paper.run_document import provenance
from vocalis_paper.run_score import cases_for, judge
from vocalis_paper.study import PHYSICS, coarse

_PAPER = FoldConstants()
Progress = Callable[[int, int], None]
Values = dict[str, float]


@dataclass(frozen=True, slots=True)
class Factor:
    """One factor of the study, varied on a logarithmic scale between ``low`` and ``high``."""

    name: str
    unit: str
    low: float
    high: float


#: K_coup_level multiplies both ends of the coupling stiffness, K_coup_contrast the ratio of the two.
CONSTANTS = (
    Factor("C_coup_pa_s_m", "Pa·s/m", 30, 900),
    Factor("A_muc_0_m2", "m²", 5e-6, 9e-6),
    Factor("K_coup_level", "1", 1.6, 4.4),
    Factor("K_coup_contrast", "1", 0.4, 2.0),
    Factor("K_col_pa_m", "Pa/m", 1.4e6, 3.5e6),
    Factor("C_col_pa_s_m", "Pa·s/m", 100, 500),
    Factor("eta_m_pa_s", "Pa·s", 0.4, 1.0),
    Factor("G_m_pa", "Pa", 25, 120),
)
POSTURE = (
    Factor("lca_ia", "1", 0.45, 0.8),
    Factor("ct", "1", 0.07, 0.3),
    Factor("ta", "1", 0.25, 0.55),
    Factor("pca", "1", 0.08, 0.23),
)
FACTORS = (*CONSTANTS, *POSTURE)
#: Each round: how many candidates, in what share of each factor's logarithmic range.
ROUNDS = ((40, 1.0), (24, 0.4), (16, 0.2))
POSTURES = 6
#: Norms that a variant must meet, and those from which on the claims are judged, to see what they cost.
WANTED, ENOUGH = 12, 10
CLAIMS_RUN_S = 0.5
SEED = 20261125


class Candidate(NamedTuple):
    """One candidate: its factors, the judged norms, how far those out of range are, in widths of their ranges, and
    the verdicts of the paper's claims by key; None: it meets too few norms to be asked.
    """

    values: Values
    judged: dict[str, Any]
    distance: float
    claims: dict[str, str] | None = None

    @property
    def in_range(self) -> int:
        return self.judged["in_range"]

    def count(self, verdict: str) -> int:
        return sum(found == verdict for found in (self.claims or {}).values())

    @property
    def by_norms(self) -> tuple[int, float]:
        return -self.in_range, self.distance

    @property
    def rank(self) -> tuple[float, ...]:
        """The wanted norms first, then the fewest claims that fail and the most that pass."""
        missing = max(WANTED - self.in_range, 0) if self.claims else WANTED
        return missing, self.count(FAIL), -self.count(PASS), *self.by_norms

    def beats(self, other: "Candidate") -> bool:
        """Whether it is as good in norms, claims that pass and claims that fail, and better in one of them."""
        mine, its = ((c.in_range, c.count(PASS), -c.count(FAIL)) for c in (self, other))
        return mine != its and all(a >= b for a, b in zip(mine, its, strict=True))


def base_of(values: Mapping[str, float]) -> Simulation:
    """The request of a candidate, two-way coupled, all constants but the factors the paper's."""
    spread = sqrt(values["K_coup_contrast"])
    own = {f.name: values[f.name] for f in CONSTANTS if f.name in FoldConstants.__dataclass_fields__}
    return simulation_from_dict(
        {
            "model": {"coupling": "two_way"},
            "activation": {
                "lca": values["lca_ia"], "ia": values["lca_ia"],
                **{name: values[name] for name in ("ct", "ta", "pca")},
            },
            "constants": {
                **own,
                "K_coup_min_pa_m": _PAPER.K_coup_min_pa_m * values["K_coup_level"] / spread,
                "K_coup_max_pa_m": _PAPER.K_coup_max_pa_m * values["K_coup_level"] * spread,
            },
        }
    )  # fmt: skip


def distance(rows: Mapping[str, Mapping[str, Any]]) -> float:
    """Sum over the fifteen of how far a number lies out of its range, in widths of the range; 1 without a number."""
    total = 0.0
    for key in FIFTEEN:
        norm, value = NORMS[key], rows[key]["value"]
        beyond = 1.0 if value is None else max(norm.low - value, value - norm.high, 0.0) / (norm.high - norm.low)
        total += min(beyond, 1.0)
    return total


def in_best_posture(postures: Sequence[Values], constants: Values) -> Candidate:
    """Run and judge one set of constants by the norms in each posture, in a worker; the best of them."""
    return min((_by_norms(constants | posture) for posture in postures), key=lambda candidate: candidate.by_norms)


def _by_norms(values: Values) -> Candidate:
    result = judged({name: answer(request) for name, request in requests(base_of(values)).items()})
    return Candidate(values, result, distance(result["norms"]))


def with_claims(candidate: Candidate, pool: ProcessPoolExecutor) -> Candidate:
    """The candidate with the paper's claims judged, if it meets enough norms."""
    if candidate.in_range < ENOUGH:
        return candidate
    base = base_of(candidate.values)
    base = replace(base, run=replace(base.run, duration_s=CLAIMS_RUN_S))
    cases = {key: coarse(case) for key, case in cases_for(base, PHYSICS).items()}
    outcomes = judge(gather(cases, pool).evidence, PHYSICS)
    return candidate._replace(claims={key: str(outcome.verdict) for key, outcome in outcomes.items()})


def design(factors: Sequence[Factor], count: int, seed: int) -> list[Values]:
    """``count`` candidates on a Latin hypercube over the logarithms of the factors."""
    cube = qmc.LatinHypercube(len(factors), seed=seed).random(count)
    return [{f.name: f.low * (f.high / f.low) ** float(u) for f, u in zip(factors, row, strict=True)} for row in cube]


def around(best: Mapping[str, float], factors: Sequence[Factor], share: float) -> tuple[Factor, ...]:
    """A smaller box: ``share`` of each logarithmic range, centred on the best candidate and kept inside the first."""
    boxes = []
    for f in factors:
        half = (f.high / f.low) ** (share / 2)
        boxes.append(Factor(f.name, f.unit, max(f.low, best[f.name] / half), min(f.high, best[f.name] * half)))
    return tuple(boxes)


def study_document(
    pool: ProcessPoolExecutor,
    progress: Progress = lambda done, total: None,
    rounds: Sequence[tuple[int, float]] = ROUNDS,
) -> dict[str, Any]:
    """Run the study: the best candidates, those that no other beats, and how the constants move what is judged."""
    warm_up(base_of(design(FACTORS, 1, SEED)[0]))
    found: list[Candidate] = []
    boxes, effects = (CONSTANTS, POSTURE), {}
    for number, (count, share) in enumerate(rounds):
        if found:
            best = min(found, key=lambda candidate: candidate.rank).values
            boxes = (around(best, CONSTANTS, share), around(best, POSTURE, share))
        postures = design(boxes[1], POSTURES, SEED + number)
        plan = design(boxes[0], count, SEED + number)
        for candidate in pool.map(partial(in_best_posture, postures), plan):
            found.append(with_claims(candidate, pool))
            progress(len(found), sum(planned for planned, _ in rounds))
        effects = effects or _effects(found)
    ranked = sorted(found, key=lambda candidate: candidate.rank)
    return {
        "kind": "calibration",
        "provenance": provenance(),
        "factors": [{"name": f.name, "unit": f.unit, "low": f.low, "high": f.high} for f in FACTORS],
        "candidates": len(found),
        "judged_by_claims": sum(candidate.claims is not None for candidate in found),
        "best": [_plain(candidate) for candidate in ranked[:10]],
        "front": [_plain(candidate) for candidate in front(ranked)],
        "effects": effects,
    }


def front(found: Iterable[Candidate]) -> list[Candidate]:
    """The candidates that none beats in norms and claims at once, most norms first; of equals the first."""
    asked = [candidate for candidate in found if candidate.claims is not None]
    kept = {}
    for candidate in asked:
        if not any(other.beats(candidate) for other in asked):
            kept.setdefault((candidate.in_range, candidate.count(PASS), candidate.count(FAIL)), candidate)
    return [kept[key] for key in sorted(kept, reverse=True)]


def _effects(found: Sequence[Candidate]) -> dict[str, dict[str, float]]:
    table = {key: _correlations((c.values, c.judged["norms"][key]["value"]) for c in found) for key in FIFTEEN}
    asked = [candidate for candidate in found if candidate.claims is not None]
    for verdict in (PASS, FAIL):
        table[f"claims that {verdict}"] = _correlations((c.values, c.count(verdict)) for c in asked)
    return table


def _correlations(numbers: Iterable[tuple[Values, float | None]]) -> dict[str, float]:
    """Rank correlation of a number with each constant."""
    known = [(values, value) for values, value in numbers if value is not None]
    column = [value for _, value in known]
    if len(set(column)) < 2:  # what never moves goes with nothing
        return dict.fromkeys((f.name for f in CONSTANTS), 0.0)
    return {
        f.name: round(float(spearmanr([log(values[f.name]) for values, _ in known], column).statistic), 2)
        for f in CONSTANTS
    }


def _plain(candidate: Candidate) -> dict[str, Any]:
    return {
        "values": {name: float(f"{value:.3g}") for name, value in candidate.values.items()},
        "in_range": candidate.in_range,
        "distance": round(candidate.distance, 3),
        "norms": {key: candidate.judged["norms"][key]["value"] for key in FIFTEEN},
        "claims": candidate.claims,
    }
