"""From evidence to outcomes: judging the 29 claims, and the hash of their definitions."""

import hashlib
from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from vfcore.spec.simulation import Simulation
from vocalis.studies.paper.bands import FAIL
from vocalis.studies.paper.cases import CASES, Case
from vocalis.studies.paper.claims.claim import Claim, ClaimOutcome, Verdict
from vocalis.studies.paper.claims.registry import CLAIMS
from vocalis.studies.paper.run.gather import Failure

#: The files that decide a verdict; runs, reports and pictures do not.
DEFINITIONS = (
    "bands.py",
    "cases.py",
    "claims/*.py",
    "evidence.py",
    "geometry.py",
    "trends.py",
    "vibration.py",
    "voicing.py",
)


def definitions_hash(room: Path = Path(__file__).parents[1]) -> str:
    """SHA-256 of the source of all definitions: scores with another hash were judged by other rules."""
    digest = hashlib.sha256()
    for path in sorted(path for pattern in DEFINITIONS for path in room.glob(pattern)):
        digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


def cases_for(base: Simulation, claims: Mapping[str, Claim] = CLAIMS) -> dict[str, Case]:
    """The cases that ``claims`` need, run from ``base`` instead of the default request."""
    needed = {key for claim in claims.values() for key in claim.needs}
    return {key: replace(case, base=base) for key, case in CASES.items() if key in needed}


def judge(found: Mapping[str, Any], claims: Mapping[str, Claim] = CLAIMS) -> dict[str, ClaimOutcome]:
    """The outcome of each claim; a claim whose run has no answer fails with the reason."""
    return {key: _judge(claim, found) for key, claim in claims.items()}


def _judge(claim: Claim, found: Mapping[str, Any]) -> ClaimOutcome:
    for case in claim.needs:
        if isinstance(found[case], Failure):
            return ClaimOutcome(FAIL, (), f"No run to judge ({CASES[case].title}): {found[case].reason}")
    return claim.judge(found)


def score(outcomes: Mapping[str, ClaimOutcome]) -> dict[str, int]:
    """How many claims pass, deviate and fail."""
    counted = Counter(outcome.verdict for outcome in outcomes.values())
    return {str(verdict): counted[verdict] for verdict in Verdict}
