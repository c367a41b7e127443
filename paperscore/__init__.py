"""The paper's claims as numbers: what each one says, how it is tested, and what counts as holding.

A claim is a row of ``CLAIMS``. Its check is a function of plain data (``vocalis_paper.evidence``) and never runs
anything; ``CASES`` names the runs whose results it needs.
"""

from vocalis_paper.cases import CASES, Case
from vocalis_paper.claim import Claim, Measured, Outcome, Verdict
from vocalis_paper.registry import CLAIMS

__all__ = ["CASES", "CLAIMS", "Case", "Claim", "Measured", "Outcome", "Verdict"]
