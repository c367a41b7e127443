"""Comparison of the voice with published norms of men."""

from vocalis.studies.norms.norms import NORMS, Norm
from vocalis.studies.norms.score import norms_document, score_variant

__all__ = ["NORMS", "Norm", "norms_document", "score_variant"]
