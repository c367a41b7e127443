"""The row of one point: phonation state and scalars, with a reason for each missing value."""

import json
import zlib
from typing import NamedTuple

import numpy as np

from vfcore.errors import VocalisError
from vfcore.io.result_document import Quantity
from vfcore.measures.catalogue import CATALOGUE
from vfcore.measures.measure import Measure
from vfcore.runs.many import Point
from vfcore.runs.sweep.plan import Sweep

#: The scalar that every point has in addition to the measures.
PERIODICITY = "periodicity"
_EXTRA = {PERIODICITY: Quantity("1", "", "normalised autocorrelation peak")}
_NOT_FINITE = "The computed value is not a finite number."


class Row(NamedTuple):
    """``state`` None: the point has no answer, and ``problem`` says why. ``values`` (columns,): NaN where missing;
    ``reasons``: for missing values, the columns of each reason.
    """

    state: str | None
    values: np.ndarray
    reasons: dict[str, list[int]]
    problem: str | None


def columns(sweep: Sweep) -> dict[str, Quantity]:
    """The scalars of a sweep in order: unit, symbol and name by key."""
    wanted = CATALOGUE.keys() if sweep.measures is None else sweep.measures
    return {key: Quantity(CATALOGUE[key].unit, CATALOGUE[key].symbol, CATALOGUE[key].name) for key in wanted} | _EXTRA


def row_of(point: Point | VocalisError, keys: list[str]) -> Row:
    """The row of a computed point."""
    if isinstance(point, VocalisError):
        return failed_row(str(point), len(keys))
    report = point.report
    values = np.full(len(keys), np.nan)
    reasons: dict[str, list[int]] = {}
    for column, key in enumerate(keys):
        measure = Measure(report.periodicity, "1", report.explanation) if key == PERIODICITY else report.measures[key]
        value, reason = measure.value, measure.reason
        if value is not None and np.isfinite(value):
            values[column] = value
        else:
            reasons.setdefault(reason or _NOT_FINITE, []).append(column)
    return Row(report.state, values, reasons, None)


def failed_row(problem: str, width: int) -> Row:
    """The row of a point without an answer."""
    return Row(None, np.full(width, np.nan), {}, problem)


def encode(row: Row) -> bytes:
    """A row as bytes: values as little-endian float64, then the rest as JSON; compressed, checksummed."""
    rest = json.dumps([row.state, row.reasons, row.problem], ensure_ascii=False, separators=(",", ":")).encode()
    values = row.values.astype("<f8").tobytes()
    return zlib.compress(len(row.values).to_bytes(2, "little") + values + rest, 1)


def decode(data: bytes) -> Row:
    """The inverse of ``encode``; zlib.error for damaged data."""
    plain = zlib.decompress(data)
    end = 2 + 8 * int.from_bytes(plain[:2], "little")
    state, reasons, problem = json.loads(plain[end:])
    return Row(state, np.frombuffer(plain[2:end], dtype="<f8"), reasons, problem)
