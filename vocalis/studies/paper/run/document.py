"""The scoreboard as a plain document for JSON, the HTML report and docs/scoreboard.md."""

import math
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from datetime import UTC, datetime
from importlib.metadata import version
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

from vfcore.spec.request import document_of, resolve
from vfcore.spec.simulation import Simulation
from vfcore.version import CODE_VERSION, MODEL_VERSION
from vocalis.studies.paper.claims.claim import Claim, ClaimOutcome
from vocalis.studies.paper.claims.registry import CLAIMS
from vocalis.studies.paper.evidence import ActivationMap, PcaSweep
from vocalis.studies.paper.run.gather import Gathered, gather, warm_up
from vocalis.studies.paper.run.score import cases_for, definitions_hash, judge, score

#: The two readings of the paper, scored by default: its numbers, and its text to the letter.
READINGS = ("paper", "text_literal")
#: Significant digits of stored numbers: more than any verdict needs, few enough to keep the document small.
FIGURES = 6


class Scored(NamedTuple):
    """One variant: its runs, outcomes and run time."""

    base: Simulation
    gathered: Gathered
    outcomes: dict[str, ClaimOutcome]
    seconds: float


def score_variant(
    variant: str,
    pool: ProcessPoolExecutor,
    claims: Mapping[str, Claim] = CLAIMS,
    progress: Callable[[str, int, int], None] = lambda case, done, total: None,
) -> Scored:
    """Run and judge ``claims`` for one model variant with its own source–tract coupling."""
    began = perf_counter()
    base = resolve({"model.variant": variant})
    warm_up(base)
    gathered = gather(cases_for(base, claims), pool, progress)
    return Scored(base, gathered, judge(gathered.evidence, claims), perf_counter() - began)


def scoreboard(scored: Mapping[str, Scored], claims: Mapping[str, Claim] = CLAIMS) -> dict[str, Any]:
    """The document: claims, and per variant its score, outcomes, failed runs, maps and curves."""
    return {
        "kind": "scoreboard",
        "provenance": provenance(),
        "claims": [_claim(claim) for claim in claims.values()],
        "variants": {name: _variant(one) for name, one in scored.items()},
    }


def provenance() -> dict[str, str]:
    """Versions of model, code, definitions and libraries, and the time."""
    return {
        "model_version": MODEL_VERSION,
        "code_version": CODE_VERSION,
        "definitions_sha256": definitions_hash(),
        "numba_version": version("numba"),
        "numpy_version": version("numpy"),
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
    }


def _claim(claim: Claim) -> dict[str, Any]:
    names = "key", "title", "paper_says", "definition", "picture"
    return {name: getattr(claim, name) for name in names} | {"needs": list(claim.needs)}


def _variant(one: Scored) -> dict[str, Any]:
    return {
        "request": document_of(one.base),
        "seconds": round(one.seconds, 1),
        "score": score(one.outcomes),
        "outcomes": {key: plain_outcome(outcome) for key, outcome in one.outcomes.items()},
        "failed_runs": [
            {"case": case, "activation": activation, "reason": reason}
            for case, activation, reason in one.gathered.failures
        ],
        "states": _states(one.gathered.evidence),
        "tables": {
            case: {name: _plain(column) for name, column in found._asdict().items()}
            for case, found in one.gathered.evidence.items()
            if isinstance(found, ActivationMap | PcaSweep)
        },
    }


def plain_outcome(outcome: ClaimOutcome) -> dict[str, Any]:
    """Verdict, sentence and numbers as plain values."""
    return {
        "verdict": str(outcome.verdict),
        "sentence": outcome.sentence,
        "measured": [{"name": m.name, "value": plain_number(m.value), "unit": m.unit} for m in outcome.measured],
    }


def _states(found: Mapping[str, Any]) -> dict[str, dict[str, int]]:
    """Number of runs of each case by phonation state."""
    counted = {}
    for case, one in found.items():
        if hasattr(one, "state"):
            names, counts = np.unique(np.atleast_1d(one.state), return_counts=True)
            counted[case] = {str(name): int(count) for name, count in zip(names, counts, strict=True)}
    return counted


def _plain(values: np.ndarray) -> Sequence[Any]:
    return [_plain(v) if isinstance(v, np.ndarray) else plain_number(v) for v in values]


def plain_number(value: Any) -> Any:
    """A JSON value: rounded to the stored digits, None for a number that is not finite."""
    if value is None or isinstance(value, str):
        return None if value is None else str(value)
    return float(f"{value:.{FIGURES}g}") if math.isfinite(value) else None
