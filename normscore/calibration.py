"""The designed study behind the variant ``human``: which constants, in which posture, are nearest to the norms.

A Latin hypercube over the constants that may change and over the posture, then a second one in a smaller box around
the best candidate; every candidate is run and judged by the norms themselves, with two-way coupling. Run it with
`vocalis norms --study`. Ranges are those in which the constants have been measured or used; see vfcore.variants.
"""

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from math import log
from typing import Any, NamedTuple

from scipy.stats import qmc, spearmanr

from vfcore.constants import FoldConstants
from vfcore.params import Simulation
from vfcore.request import simulation_from_dict
from vocalis_norms.efforts import requests
from vocalis_norms.norms import FIFTEEN, NORMS
from vocalis_norms.score import answer, judged
from vocalis_paper.run import warm_up
from vocalis_paper.run_document import provenance

_PAPER = FoldConstants()
Progress = Callable[[int, int], None]


@dataclass(frozen=True, slots=True)
class Factor:
    """One factor of the study, varied on a logarithmic scale between ``low`` and ``high``."""

    name: str
    unit: str
    low: float
    high: float


FACTORS = (
    Factor("C_coup_pa_s_m", "Pa·s/m", 300, 1000),
    Factor("A_muc_0_m2", "m²", 5e-6, 1.1e-5),
    Factor("K_col_pa_m", "Pa/m", 8e5, 2.2e6),
    Factor("K_coup_ratio", "1", 0.8, 1.5),
    Factor("lca_ia", "1", 0.45, 0.8),
    Factor("ct", "1", 0.1, 0.45),
    Factor("ta", "1", 0.05, 0.5),
)
FIRST_ROUND, SECOND_ROUND = 240, 120
#: The second box: this share of each factor's logarithmic range, around the best candidate of the first.
SECOND_BOX = 0.35
SEED = 20261125


class Candidate(NamedTuple):
    """One candidate: its factors, the judged norms, and how far those out of range are, in widths of their ranges."""

    values: dict[str, float]
    judged: dict[str, Any]
    distance: float

    @property
    def rank(self) -> tuple[int, float]:
        return -self.judged["in_range"], self.distance


def base_of(values: Mapping[str, float]) -> Simulation:
    """The request of a candidate, two-way coupled, all constants but the factors the paper's."""
    ratio = values["K_coup_ratio"]
    return simulation_from_dict(
        {
            "model": {"coupling": "two_way"},
            "activation": {"lca": values["lca_ia"], "ia": values["lca_ia"], "ct": values["ct"], "ta": values["ta"]},
            "constants": {
                **{name: values[name] for name in ("C_coup_pa_s_m", "A_muc_0_m2", "K_col_pa_m")},
                "K_coup_min_pa_m": _PAPER.K_coup_min_pa_m * ratio,
                "K_coup_max_pa_m": _PAPER.K_coup_max_pa_m * ratio,
            },
        }
    )


def distance(rows: Mapping[str, Mapping[str, Any]]) -> float:
    """Sum over the fifteen of how far a number lies out of its range, in widths of the range; 1 without a number."""
    total = 0.0
    for key in FIFTEEN:
        norm, value = NORMS[key], rows[key]["value"]
        beyond = 1.0 if value is None else max(norm.low - value, value - norm.high, 0.0) / (norm.high - norm.low)
        total += min(beyond, 1.0)
    return total


def try_out(values: dict[str, float]) -> Candidate:
    """Run and judge one candidate, in a worker."""
    result = judged({name: answer(request) for name, request in requests(base_of(values)).items()})
    return Candidate(values, result, distance(result["norms"]))


def design(factors: Sequence[Factor], count: int, seed: int) -> list[dict[str, float]]:
    """``count`` candidates on a Latin hypercube over the logarithms of the factors."""
    cube = qmc.LatinHypercube(len(factors), seed=seed).random(count)
    return [{f.name: f.low * (f.high / f.low) ** float(u) for f, u in zip(factors, row, strict=True)} for row in cube]


def around(best: Mapping[str, float]) -> tuple[Factor, ...]:
    """The smaller box: SECOND_BOX of each range, centred on the best candidate and kept inside the first box."""
    boxes = []
    for f in FACTORS:
        half = (f.high / f.low) ** (SECOND_BOX / 2)
        boxes.append(Factor(f.name, f.unit, max(f.low, best[f.name] / half), min(f.high, best[f.name] * half)))
    return tuple(boxes)


def study_document(
    pool: ProcessPoolExecutor, progress: Progress = lambda done, total: None, first=FIRST_ROUND, second=SECOND_ROUND
) -> dict[str, Any]:
    """Run the study: the best candidates, and how each factor moves each norm (rank correlation, first round)."""
    plan = design(FACTORS, first, SEED)
    warm_up(base_of(plan[0]))
    total, found = first + second, []
    for candidate in pool.map(try_out, plan, chunksize=2):
        found.append(candidate)
        progress(len(found), total)
    effects = _effects(found)
    best = min(found, key=lambda candidate: candidate.rank)
    for candidate in pool.map(try_out, design(around(best.values), second, SEED + 1), chunksize=2):
        found.append(candidate)
        progress(len(found), total)
    return {
        "kind": "calibration",
        "provenance": provenance(),
        "factors": [{"name": f.name, "unit": f.unit, "low": f.low, "high": f.high} for f in FACTORS],
        "candidates": len(found),
        "best": [_plain(candidate) for candidate in sorted(found, key=lambda candidate: candidate.rank)[:10]],
        "effects": effects,
    }


def _effects(found: Sequence[Candidate]) -> dict[str, dict[str, float]]:
    table = {}
    for key in FIFTEEN:
        numbers = [(c.values, c.judged["norms"][key]["value"]) for c in found]
        numbers = [(values, value) for values, value in numbers if value is not None]
        table[key] = {
            f.name: round(float(spearmanr([log(v[f.name]) for v, _ in numbers], [x for _, x in numbers]).statistic), 2)
            for f in FACTORS
        }
    return table


def _plain(candidate: Candidate) -> dict[str, Any]:
    return {
        "values": {name: float(f"{value:.3g}") for name, value in candidate.values.items()},
        "in_range": candidate.judged["in_range"],
        "distance": round(candidate.distance, 3),
        "norms": {key: candidate.judged["norms"][key]["value"] for key in FIFTEEN},
    }
