"""Scoring of a variant by the norms: runs, verdicts, and one plain document for JSON, HTML and the docs."""

from collections.abc import Callable, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict
from math import isfinite, nan
from typing import Any

from vfcore.errors import VocalisError
from vfcore.runs.one import simulate
from vfcore.spec.request import document_of, resolve
from vfcore.spec.simulation import Simulation
from vocalis.studies.norms.efforts import POSTURE, requests
from vocalis.studies.norms.norms import FIFTEEN, NORMS, Norm
from vocalis.studies.norms.reading import NO_VOICE, FlowMeasures, NormReading, reading
from vocalis.studies.paper.bands import DEVIATION, FAIL, PASS, between
from vocalis.studies.paper.claims.claim import Verdict
from vocalis.studies.paper.run.document import provenance
from vocalis.studies.paper.run.gather import warm_up

Progress = Callable[[int, int], None]


class _NoNumbers(dict):
    """Measures of a run without an answer: all NaN."""

    def __missing__(self, key: str) -> float:
        return nan


def answer(request: Simulation) -> NormReading:
    """The numbers of one run; NaN for a run without an answer. Runs in a worker."""
    try:
        return reading(simulate(request))
    except VocalisError:
        return NormReading(NO_VOICE, _NoNumbers(), FlowMeasures())


def judge(norm: Norm, value: float) -> tuple[Verdict, str]:
    """ "pass" within the range, "deviation" with its size outside, "fail" without a number."""
    if not isfinite(value):
        return FAIL, "no number: no trackable voice"
    verdict = between(value, (norm.low, norm.high), (-float("inf"), float("inf")))
    if verdict is PASS:
        return PASS, ""
    end = norm.low if value < norm.low else norm.high
    return DEVIATION, f"{value - end:+.{norm.decimals}f} {'' if norm.unit == '1' else norm.unit}".strip()


def score_variant(
    variant: str, coupling: str | None, pool: ProcessPoolExecutor, progress: Progress = lambda done, total: None
) -> dict[str, Any]:
    """Run and judge one variant; ``coupling`` None: that of the variant."""
    base = resolve({"model": {"variant": variant, "coupling": coupling}, "activation": asdict(POSTURE)})
    return score_base(base, pool, progress)


def score_base(
    base: Simulation, pool: ProcessPoolExecutor, progress: Progress = lambda done, total: None
) -> dict[str, Any]:
    """Run and judge the voice of a base request; pressures, vowels and durations are those of the norms."""
    warm_up(base)
    wanted = requests(base)
    runs = {}
    for name, found in zip(wanted, pool.map(answer, wanted.values()), strict=True):
        runs[name] = found
        progress(len(runs), len(wanted))
    return {
        "request": document_of(wanted["normal"]),
        "states": {name: found.state for name, found in runs.items() if not name.startswith("threshold")},
        **judged(runs),
    }


def judged(runs: Mapping[str, NormReading]) -> dict[str, Any]:
    """Every norm with its number, and how many of the fifteen are in range."""
    rows = {}
    for key, norm in NORMS.items():
        value = float(norm.read(runs))
        verdict, beyond = judge(norm, value)
        rows[key] = {"value": round(value, 6) if isfinite(value) else None, "verdict": str(verdict), "beyond": beyond}
    in_range = sum(rows[key]["verdict"] == PASS for key in FIFTEEN)
    return {"norms": rows, "in_range": in_range, "of": len(FIFTEEN)}


def norms_document(scored: Mapping[str, dict[str, Any]]) -> dict[str, Any]:
    """The document: the norms, and per column (variant and coupling) every number and verdict."""
    return {
        "kind": "norms",
        "provenance": provenance(),
        "norms": [
            {name: getattr(norm, name) for name in Norm.__dataclass_fields__ if name != "read"}
            for norm in NORMS.values()
        ],
        "columns": dict(scored),
    }
