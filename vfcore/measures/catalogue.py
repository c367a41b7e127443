"""The catalogue of measures, and the one call that measures signals with all of them."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, fields

from vfcore.errors import ParameterError
from vfcore.measures.analysis import Analysis
from vfcore.measures.measure import Measure
from vfcore.measures.measure_spec import MeasureSpec
from vfcore.measures.pitch import Autocorrelation
from vfcore.measures.rows import ROWS
from vfcore.measures.signals import Signals, Sound


class Catalogue:
    """The measures in the order of display, addressed by key."""

    def __init__(self, rows: tuple[MeasureSpec, ...]):
        self._by_key = {row.key: row for row in rows}
        if len(self._by_key) != len(rows):
            raise ValueError("two rows of the catalogue have the same key")

    def __iter__(self) -> Iterator[MeasureSpec]:
        return iter(self._by_key.values())

    def __len__(self) -> int:
        return len(self._by_key)

    def __getitem__(self, key: str) -> MeasureSpec:
        return self._by_key[key]

    def keys(self) -> tuple[str, ...]:
        return tuple(self._by_key)

    def measurable(self, signals: Signals) -> tuple[str, ...]:
        """Keys of the measures whose needed signals are all given; those that need a state may still have no value."""
        return tuple(spec.key for spec in self if signals.given.issuperset(spec.signals))

    def as_rows(self) -> list[dict]:
        """The catalogue as plain values for JSON, tables and docs."""
        return [_plain(spec) for spec in self]


@dataclass(frozen=True, slots=True)
class MeasureReport:
    """What was measured.

    ``state``: none | periodic | subharmonic | irregular, with the sentence ``explanation``.
    ``periodicity``: normalised autocorrelation peak, None without phonation. ``measures``: by key, every row of the
    catalogue or the wanted ones. ``cycles``: how many cycles were averaged. ``cycle_bounds``: samples [start, stop)
    of one representative repeating pattern in the waves, None where no cycle can be followed. ``judged``: name of the
    signal from which state and cycles come, the glottal area, else the flow, else the sound; None where none is given.
    """

    state: str
    explanation: str
    periodicity: float | None
    measures: dict[str, Measure]
    cycles: int
    cycle_bounds: tuple[int, int] | None
    judged: str | None = None


CATALOGUE = Catalogue(ROWS)


def known_keys(keys: Sequence[str]) -> tuple[str, ...]:
    """``keys`` of the catalogue; ParameterError("measures", …) for any other."""
    known = CATALOGUE.keys()
    for key in keys:
        if key not in known:
            raise ParameterError("measures", f"{key!r} is not a measure", ", ".join(known))
    return tuple(keys)


def measure_all(
    signals: Signals,
    keys: Sequence[str] | None = None,
    radiate: Callable[[], Sound] | None = None,
    correlate: Callable[[], Autocorrelation] | None = None,
) -> MeasureReport:
    """Measures on the measured part of ``signals``; the phonation state comes first.

    ``keys``: those wanted, None for every one of the catalogue; each has the same value whatever else is wanted. A
    measure whose signals are not given has no value and a reason. ``radiate``: called for the sound when a measure
    needs it; None where the signals hold what there is of it. ``correlate``: called for the autocorrelation of the
    measured area, unless the glottis hardly moves; None where it is to be computed here. Raises ParameterError for an
    unknown key.
    """
    wanted = CATALOGUE if keys is None else [CATALOGUE[key] for key in known_keys(keys)]
    analysis = Analysis(signals, radiate, correlate)
    cycles = analysis.followed_cycles
    return MeasureReport(
        state=analysis.phonation.state,
        explanation=analysis.phonation.explanation,
        periodicity=analysis.phonation.periodicity,
        measures={spec.key: spec.measure(analysis) for spec in wanted},
        cycles=cycles.count if cycles else 0,
        cycle_bounds=cycles.representative if cycles else None,
        judged=analysis.judged,
    )


def _plain(spec: MeasureSpec) -> dict:
    row = {field.name: getattr(spec, field.name) for field in fields(spec) if field.name not in _NOT_PLAIN}
    normal = spec.normal_range
    row["signals"] = list(spec.signals)
    row["needs"] = spec.needs.value
    row["normal_range"] = (
        None if normal is None else {"low": normal.low, "high": normal.high, "who": normal.who, "source": normal.source}
    )
    return row


_NOT_PLAIN = ("compute", "needs", "normal_range")
