"""The voice against published norms of men: which numbers, whose, how measured, and how far the model is from them."""

from vocalis_norms.norms import NORMS, Norm
from vocalis_norms.score import norms_document, score_variant

__all__ = ["NORMS", "Norm", "norms_document", "score_variant"]
