"""What one row of the catalogue of measures says, which signals it needs, and when it applies."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

from vfcore.measures.analysis import Analysis
from vfcore.measures.measure import Measure, Missing
from vfcore.measures.signals import missing_sentence


class Needs(Enum):
    """What must be there before a measure makes sense."""

    NOTHING = "nothing: given for every run"
    PHONATION = "sustained phonation"
    CYCLES = "cycles that can be followed"
    PERIODIC = "periodic phonation"
    IRREGULAR = "irregular phonation with cycles that can be followed"


_WRONG_STATE = {
    (Needs.PERIODIC, "subharmonic"): "Not applicable: the first harmonic of a subharmonic voice is the subharmonic.",
    (Needs.PERIODIC, "irregular"): "Not applicable: an irregular voice has no steady harmonics.",
    (Needs.IRREGULAR, "periodic"): (
        "Not applicable: a deterministic model repeats its cycle, so this would be a rounding error, "
        "not a sign of a healthy voice."
    ),
    (Needs.IRREGULAR, "subharmonic"): (
        "Not applicable: the regular alternation of a subharmonic voice is not perturbation (Titze 1995)."
    ),
}


@dataclass(frozen=True, slots=True)
class NormalRange:
    """Values to expect, ``low`` to ``high`` (equal where only a mean is published), in whom, and the source."""

    low: float
    high: float
    who: str
    source: str


@dataclass(frozen=True, slots=True)
class MeasureSpec:
    """One measure: everything the API, the tables, the tooltips and the docs say of it, and how it is computed.

    ``definition`` is a sentence for a reader, ``formula`` the same in symbols, ``threshold`` the constants in it,
    ``signal`` a description of what is measured. ``signals``: names of what must be given, fields of ``Signals`` or
    alternatives of signals.ALTERNATIVES. ``version`` changes when the same waveforms would give another number.
    """

    key: str
    symbol: str
    name: str
    unit: str
    group: str
    signal: str
    signals: tuple[str, ...]
    definition: str
    formula: str
    source: str
    needs: Needs
    compute: Callable[[Analysis], float | Missing]
    decimals: int
    threshold: str = ""
    normal_range: NormalRange | None = None
    version: str = "1"

    def measure(self, analysis: Analysis) -> Measure:
        """The value, or the reason why there is none."""
        reason = self._obstacle(analysis)
        if reason is None:
            outcome = self.compute(analysis)
            if not isinstance(outcome, Missing):
                return Measure(outcome, self.unit)
            reason = outcome.reason
        return Measure(None, self.unit, reason)

    def _obstacle(self, analysis: Analysis) -> str | None:
        if not analysis.given.issuperset(self.signals):
            return missing_sentence([name for name in self.signals if name not in analysis.given])
        state = analysis.phonation.state
        if self.needs is Needs.NOTHING:
            return None
        if state == "none":
            return analysis.phonation.explanation
        if (self.needs, state) in _WRONG_STATE:
            return _WRONG_STATE[self.needs, state]
        if self.needs is not Needs.PHONATION and analysis.followed_cycles is None:
            return "No sequence of cycles can be followed in the measured part."
        return None
