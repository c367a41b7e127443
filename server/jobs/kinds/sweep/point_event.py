"""``point`` events: the points of a sweep that have just been stored, several at a time."""

from typing import Any

from vfcore.runs.sweep.plan import Sweep
from vfcore.runs.sweep.row import Row, columns

#: Events of larger sweeps carry positions only: their numbers are fetched with GET …/result?partial=true.
MOST_IN_EVENTS = 2500


def point_document(job_id: str, sweep: Sweep, positions: list[int], rows: list[Row] | None) -> dict[str, Any]:
    """``index``: positions in C order of the axes; the other lists have its order, null where there is no value."""
    document: dict[str, Any] = {"id": job_id, "index": positions}
    if rows is None or len(sweep) > MOST_IN_EVENTS:
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
