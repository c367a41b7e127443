"""One measured value: a number with its unit, or a sentence that says why there is none."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Missing:
    """What is returned for a measure that cannot be computed: the reason, a sentence."""

    reason: str


@dataclass(frozen=True, slots=True)
class Measure:
    """``value`` in ``unit``, or None with the ``reason``."""

    value: float | None
    unit: str
    reason: str | None = None
