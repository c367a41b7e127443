"""The objective of the calibration: the shortfall of a set of constants as one graded number.

Verdicts are steps, but a search needs slopes. Norms count by their distance from the range, the claims that ``human``
used to lose (AIMS) by the distance of their numbers from a band, all other claims by their verdict. Coarse maps and
half as long runs give better numbers than full ones, so the aims are stricter than the bands of the claims. The
shortfall does not decide which set is adopted; that is judged on full maps (vocalis.studies.norms.calibration).
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from vfcore.spec.simulation import Simulation
from vocalis.studies.norms.efforts import THRESHOLD_PA, requests
from vocalis.studies.norms.factors import Values, base_of, values_at
from vocalis.studies.norms.norms import FIFTEEN, NORMS
from vocalis.studies.norms.reading import NO_VOICE
from vocalis.studies.norms.score import answer, judged
from vocalis.studies.paper.bands import DEVIATION, FAIL, PASS
from vocalis.studies.paper.cases import CASES, Case, MuscleAxis, evenly
from vocalis.studies.paper.claims.claim import ClaimOutcome
from vocalis.studies.paper.run.gather import Failure, gather_here
from vocalis.studies.paper.run.score import judge
from vocalis.studies.paper.study.designed import PHYSICS

WANTED = 12
RUN_S = 0.5
#: All claims but M2 and M3, numbers of the paper that do not hold for a voice of another size.
TRENDS = {key: claim for key, claim in PHYSICS.items() if key not in ("M2", "M3")}
RANK: dict[str, int] = {PASS: 0, DEVIATION: 1, FAIL: 2}
#: Groups of runs, the cheapest per claim first; a set that can no longer win is not run further.
STAGES = (
    ("static_adduction", "static_ta", "static_ct", "static_pca", "modal"),
    ("pca_half", "pca_full"),
    ("ct_ta_map",),
    ("pca_sweep",),
)
#: Cells of the map: CT by TA.
COARSE = (evenly(5), evenly(10))
#: Cost of a WANTED norm a range's width away, of any other norm, of a claim worse than allowed, of a claim short of
#: pass.
MISSED, SPARE, WORSE, SHORT = 3.0, 0.05, 0.7, 0.1
#: Cost of each cycle by which the flow peaks after the area.
LATE = 3.0


class Aim(NamedTuple):
    """A number of a claim: the aimed range, the cost of a miss per unit, and the largest cost."""

    part: str
    low: float
    high: float
    per_unit: float
    most: float

    def missed(self, value: float) -> float:
        beyond = max(self.low - value, value - self.high, 0.0)
        return min(beyond * self.per_unit, self.most) if np.isfinite(value) else self.most


AIMS = {
    "M8": Aim("mean |p| closing over opening", 0.0, 0.78, 1.5, 1.0),
    "M9": Aim("dip of the flow by the area peak", 0.012, 0.29, 3.0, 0.5),
    "A4": Aim("neighbours along TA with falling f_o", 0.975, 1.0, 4.0, 4.0),
}


class Tried(NamedTuple):
    """``total``: the shortfall; ``whole``: whether every stage was run; ``norms``: how many are in range; ``values``:
    theirs; ``numbers``: those of the aims.
    """

    total: float
    whole: bool
    norms: int
    values: dict[str, float | None]
    numbers: dict[str, float]


def shortfall(allowed: Mapping[str, int], voice_s: float, point: np.ndarray, limit: float) -> Tried:
    """Run and grade the set at a point of the unit cube, stopping once the total exceeds ``limit``.

    ``allowed``: the worst rank of each claim that does not count as lost; ``voice_s``: duration of the paper's three
    voices.
    """
    values = values_at(point)
    total, norms = 0.0, 0
    read: dict[str, float | None] = {}
    numbers: dict[str, float] = {}
    graded = [_claims(keys, allowed, voice_s) for keys in STAGES]
    for stage in (graded[0], _norms, *graded[1:]):
        short, found = stage(values)
        total += short
        if stage is _norms:
            norms, read = found["in_range"], {key: found["norms"][key]["value"] for key in FIFTEEN}
        else:
            numbers |= found
        if total > limit:
            return Tried(total, False, norms, read, numbers)
    return Tried(total, True, norms, read, numbers)


def _norms(values: Values) -> tuple[float, dict[str, Any]]:
    result = judged(voices(_lasting(base_of(values), RUN_S)))
    apart = sorted(distances(result["norms"]).values())
    spare = sum(SPARE for far in apart[WANTED:] if far > 0.0)
    return MISSED * sum(apart[:WANTED]) + spare + SPARE * sum(apart), result


def voices(base: Simulation) -> dict[str, Any]:
    """The runs of the norms; pressures above the threshold are not tried."""
    wanted = requests(base)
    found = {name: answer(request) for name, request in wanted.items() if not name.startswith("threshold")}
    voiced = None
    for pressure in THRESHOLD_PA:
        name = f"threshold {pressure}"
        found[name] = voiced or answer(wanted[name])
        if found[name].state != NO_VOICE:
            voiced = found[name]
    return found


def distances(rows: Mapping[str, Mapping[str, Any]]) -> dict[str, float]:
    """Distance of each of the fifteen norms from its range, in widths of the range, at most 1; 1 without a number."""
    found = {}
    for key in FIFTEEN:
        norm, value = NORMS[key], rows[key]["value"]
        beyond = 1.0 if value is None else max(norm.low - value, value - norm.high, 0.0) / (norm.high - norm.low)
        found[key] = min(beyond, 1.0)
    return found


def _claims(
    keys: tuple[str, ...], allowed: Mapping[str, int], voice_s: float
) -> Callable[[Values], tuple[float, dict[str, float]]]:
    """A stage: runs the cases ``keys`` and grades the claims that need only them."""
    claims = {key: claim for key, claim in TRENDS.items() if set(claim.needs) <= set(keys)}

    def graded(values: Values) -> tuple[float, dict[str, float]]:
        found = gather_here({key: _coarse(CASES[key], base_of(values), voice_s) for key in keys})
        outcomes = judge(found, claims)
        numbers = {key: _number(outcome, AIMS[key].part) for key, outcome in outcomes.items() if key in AIMS}
        short = sum(AIMS[key].missed(value) for key, value in numbers.items())
        for key, outcome in outcomes.items():
            rank = RANK[outcome.verdict]
            short += SHORT * rank + (WORSE * max(rank - allowed[key], 0) if key not in AIMS else 0.0)
        if "M9" in numbers and not numbers["M9"] > 0.0:  # no dip yet: graded by the delay of the flow peak
            short += LATE * _lateness(found["modal"])
        return short, numbers

    return graded


def _number(outcome: ClaimOutcome, part: str) -> float:
    found = next((m.value for m in outcome.measured if m.name == part), None)
    return float("nan") if found is None else float(found)


def _lateness(voice) -> float:
    """Delay of the flow peak after the area peak, in cycles."""
    if isinstance(voice, Failure):
        return 0.5
    count = len(voice.area_m2)
    after = int(voice.flow_m3_s.argmax()) - int(voice.area_m2.argmax())
    return max((after + count // 2) % count - count // 2, 0) / count


def _lasting(base: Simulation, seconds: float) -> Simulation:
    return replace(base, run=replace(base.run, duration_s=seconds))


def _coarse(case: Case, base: Simulation, voice_s: float) -> Case:
    case = replace(case, base=_lasting(base, voice_s if case.kind == "voice" else RUN_S))
    if case.kind == "map":
        return replace(
            case, axes=tuple(MuscleAxis(axis.muscles, at) for axis, at in zip(case.axes, COARSE, strict=True))
        )
    if case.kind == "sweep":
        return replace(case, axes=(MuscleAxis(case.axes[0].muscles, evenly(10)),))
    return case
