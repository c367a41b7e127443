"""``point`` events: what a sweep has just got, several points at a time."""

from typing import Any

from vfcore.runs.sweep.plan import Sweep
from vfcore.runs.sweep.row import Row, columns

#: Sweeps of more points tell positions only: their numbers are fetched with GET …/result?partial=true.
MOST_TOLD = 2500


def point_document(job_id: str, sweep: Sweep, positions: list[int], rows: list[Row] | None) -> dict[str, Any]:
    """``index``: positions in C order of the axes; the other lists run along it, null where there is no value."""
    document: dict[str, Any] = {"id": job_id, "index": positions}
    if rows is None or len(sweep) > MOST_TOLD:
        return document
    values = [row.values.tolist() for row in rows]
    return document | {
        "phonation_state": [row.state for row in rows],
        "measures": {
            key: [of_point[k] if of_point[k] == of_point[k] else None for of_point in values]
            for k, key in enumerate(columns(sweep))
        },
        "problems": [
            {"index": position, "detail": row.problem}
            for position, row in zip(positions, rows, strict=True)
            if row.problem
        ],
    }
