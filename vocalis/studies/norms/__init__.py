"""The voice against published norms of men: which numbers, whose, how measured, and how far the model is from them."""

from vocalis.studies.norms.norms import NORMS, Norm
from vocalis.studies.norms.score import norms_document, score_variant

__all__ = ["NORMS", "Norm", "norms_document", "score_variant"]
