"""The paper's claims as numbers: what each one says, how it is tested, and what counts as holding.

A claim is a row of ``CLAIMS``. Its check is a function of plain data (``vocalis.studies.paper.evidence``) and never
runs anything; ``CASES`` names the runs whose results it needs.
"""

from vocalis.studies.paper.cases import CASES, Case
from vocalis.studies.paper.claims.claim import Claim, Measured, Outcome, Verdict
from vocalis.studies.paper.claims.registry import CLAIMS

__all__ = ["CASES", "CLAIMS", "Case", "Claim", "Measured", "Outcome", "Verdict"]
