"""The result of a sweep, filled while it runs: scalars and a state per point, and a reason for each missing value."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from vfcore.errors import ParameterError
from vfcore.io.result_document import Quantity
from vfcore.runs.sweep.plan import Sweep
from vfcore.runs.sweep.row import Row, columns

#: Labels of ``state`` by code: pending and failed points first, then the phonation states.
STATES = ("pending", "failed", "none", "periodic", "subharmonic", "irregular")
PENDING, FAILED = 0, 1
_CODE = {name: code for code, name in enumerate(STATES)}
NOT_YET = "This point is not computed yet."


class SweepTable:
    """``values`` (points, columns) float64, NaN where missing; ``state`` (points,) codes of STATES."""

    def __init__(self, sweep: Sweep):
        self.sweep = sweep
        self.columns: dict[str, Quantity] = columns(sweep)
        self.values = np.full((len(sweep), len(self.columns)), np.nan)
        self.state = np.zeros(len(sweep), dtype=np.int8)
        self.problems: dict[int, str] = {}
        self._sentences: dict[str, int] = {}
        # 0: the value is there, or the point has no values at all; k: the k-th sentence
        self._why = np.zeros((len(sweep), len(self.columns)), dtype=np.int16)

    def put(self, position: int, row: Row) -> None:
        """Fill in one point."""
        self.values[position] = row.values
        self.state[position] = FAILED if row.state is None else _CODE[row.state]
        self._why[position] = 0
        for sentence, places in row.reasons.items():
            self._why[position, places] = self._sentences.setdefault(sentence, len(self._sentences) + 1)
        if row.problem is not None:
            self.problems[position] = row.problem

    def fill(self, rows: Iterable[tuple[int, Row]]) -> "SweepTable":
        """Fill in many points; returns itself."""
        for position, row in rows:
            self.put(position, row)
        return self

    @property
    def n_done(self) -> int:
        """Number of points computed, including failed ones."""
        return int(np.count_nonzero(self.state != PENDING))

    @property
    def n_failed(self) -> int:
        return int(np.count_nonzero(self.state == FAILED))

    def measure(self, key: str) -> np.ndarray:
        """One scalar over the axes, shape ``sweep.shape``; ParameterError for an unknown key."""
        return self.values[:, self._column(key)].reshape(self.sweep.shape)

    def states(self) -> np.ndarray:
        """The labels of STATES over the axes, shape ``sweep.shape``."""
        return np.array(STATES, dtype=object)[self.state].reshape(self.sweep.shape)

    def reason(self, key: str, position: int) -> str | None:
        """Why the value of a point is missing; None if it is there."""
        column = self._column(key)
        if np.isfinite(self.values[position, column]):
            return None
        if self.state[position] == PENDING:
            return NOT_YET
        return self.problems.get(position) or self._sentence(self._why[position, column])

    def reason_codes(self, key: str) -> tuple[np.ndarray, list[str]]:
        """Per point 0, or the number (from 1) of the sentence that says why its value is missing; then the sentences.

        Failed and pending points have 0, since their state explains them.
        """
        codes = self._why[:, self._column(key)]
        used = [code for code in np.unique(codes) if code]
        renumbered = np.zeros(int(codes.max(initial=0)) + 1, dtype=np.int16)
        renumbered[used] = np.arange(1, len(used) + 1)
        return renumbered[codes], [self._sentence(code) for code in used]

    def document(self, measures: Iterable[str] | None = None) -> dict[str, Any]:
        """The table as plain values for JSON: lists in C order of ``shape``, null where there is no value.

        ``measures``: which of the columns, all of them for None.
        """
        keys = list(self.columns) if measures is None else list(measures)
        for key in keys:
            self._column(key)
        sweep = self.sweep
        return {
            "kind": "sweep",
            "shape": list(sweep.shape),
            "n_total": len(sweep),
            "n_done": self.n_done,
            "n_failed": self.n_failed,
            "axes": [
                {
                    "name": axis.name,
                    "parameters": list(axis.parameters),
                    "label": axis.label,
                    "unit": axis.unit,
                    "values": list(axis.values),
                }
                for axis in sweep.axes
            ],
            "points": [dict(point) for point in sweep.points] or None,
            "phonation_state": [None if code <= FAILED else STATES[code] for code in self.state.tolist()],
            "measures": {key: self._measure(key) for key in keys},
            "problems": [
                {"index": int(position), "detail": self.problems[position]} for position in sorted(self.problems)
            ],
            "pending": np.flatnonzero(self.state == PENDING).tolist(),
        }

    def _measure(self, key: str) -> Mapping[str, Any]:
        quantity = self.columns[key]
        values = self.values[:, self._column(key)]
        codes, sentences = self.reason_codes(key)
        return {
            "unit": quantity.unit,
            "symbol": quantity.symbol,
            "label": quantity.label,
            "values": [value if value == value else None for value in values.tolist()],
            "reasons": [
                {"reason": sentence, "points": np.flatnonzero(codes == number).tolist()}
                for number, sentence in enumerate(sentences, 1)
            ],
        }

    def _column(self, key: str) -> int:
        if key not in self.columns:
            raise ParameterError("measures", f"{key!r} is not kept by this sweep", ", ".join(self.columns))
        return list(self.columns).index(key)

    def _sentence(self, code: int) -> str:
        return list(self._sentences)[code - 1]
