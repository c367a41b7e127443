"""The claims of the paper as numeric tests, and what runs they need.

A claim is a row of ``CLAIMS``. Its check is a pure function of evidence (``vocalis.studies.paper.evidence``); ``CASES``
names the runs that give the evidence.
"""

from vocalis.studies.paper.cases import CASES, Case
from vocalis.studies.paper.claims.claim import Claim, ClaimOutcome, Measured, Verdict
from vocalis.studies.paper.claims.registry import CLAIMS

__all__ = ["CASES", "CLAIMS", "Case", "Claim", "Measured", "ClaimOutcome", "Verdict"]
