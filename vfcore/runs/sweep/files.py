"""A sweep as netCDF-4 and CSV files, written atomically.

netCDF: a dimension and coordinate per axis (``activation_ct``; tied parameters share it), or ``point`` with a variable
per number that differs. ``phonation_state`` holds labels; every scalar is a variable with units, NaN where missing. If
any value is missing, ``<name>_reason`` holds an index into its attribute ``meanings`` (a JSON list of sentences; 0:
nothing missing).
"""

import csv
import io
import os
from collections.abc import Iterator
from typing import Any

import numpy as np

from vfcore.io.atomic import replacing, write_bytes
from vfcore.io.hdf5 import Variable, write_variables
from vfcore.io.result_document import json_text
from vfcore.runs.sweep.document import sweep_to_dict
from vfcore.runs.sweep.table import SweepTable
from vfcore.spec.fields import PAPER
from vfcore.spec.paths import known_declaration
from vfcore.version import CODE_VERSION, MODEL_VERSION

STATE, PROBLEM, POINT = "phonation_state", "problem", "point"


def write_netcdf(table: SweepTable, path: str | os.PathLike) -> None:
    """Write the file; OSError where ``path`` cannot be written."""
    with replacing(path) as draft:
        write_variables(draft, variables(table), attributes(table))


def netcdf_bytes(table: SweepTable) -> bytes:
    """The same file as bytes."""
    buffer = io.BytesIO()
    write_variables(buffer, variables(table), attributes(table))
    return buffer.getvalue()


def variables(table: SweepTable) -> dict[str, Variable]:
    """Every variable of a sweep by name, coordinates first."""
    sweep = table.sweep
    shape, found = sweep.shape, {}
    dims = tuple(axis.name for axis in sweep.axes) or (POINT,)
    for axis in sweep.axes:
        about = {"units": axis.unit, "long_name": axis.label, "parameters": json_text(list(axis.parameters))}
        found[axis.name] = Variable((axis.name,), np.array(axis.values, dtype=float), about)
    for path in () if sweep.axes else sorted({path for point in sweep.points for path in point}):
        row = known_declaration(path).metadata
        values = np.array([point.get(path, np.nan) for point in sweep.points])
        found[path.replace(".", "_")] = Variable(dims, values, {"units": row["unit"], "long_name": row["label"]})
    about = {"long_name": "phonation state; pending: not computed yet, failed: see problem"}
    found[STATE] = Variable(dims, table.states(), about)
    if table.problems:
        problems = np.array([table.problems.get(k, "") for k in range(len(sweep))], dtype=object).reshape(shape)
        found[PROBLEM] = Variable(dims, problems, {"long_name": "why a point has no answer"})
    for key, quantity in table.columns.items():
        about = {"units": quantity.unit, "long_name": quantity.label}
        found[key] = Variable(
            dims, table.measure(key), about | ({"symbol": quantity.symbol} if quantity.symbol else {})
        )
        codes, sentences = table.reason_codes(key)
        if sentences:
            about = {"long_name": f"why there is no {quantity.label}", "meanings": json_text(["", *sentences])}
            found[f"{key}_reason"] = Variable(dims, codes.reshape(shape), about)
    return found


def attributes(table: SweepTable) -> dict[str, Any]:
    """The file's global attributes, enough to reproduce it."""
    return {
        "title": "Vocalis sweep over a vocal fold",
        "source": f"Vocalis {CODE_VERSION}, model {MODEL_VERSION}",
        "references": PAPER,
        "model_version": MODEL_VERSION,
        "code_version": CODE_VERSION,
        "points": len(table.sweep),
        "points_done": table.n_done,
        "points_failed": table.n_failed,
        "request": json_text(sweep_to_dict(table.sweep)),
    }


def write_csv(table: SweepTable, path: str | os.PathLike) -> None:
    """Write the file; OSError where ``path`` cannot be written."""
    write_bytes(path, "".join(csv_lines(table)).encode())


def csv_lines(table: SweepTable) -> Iterator[str]:
    """A header, then one line per point: its numbers, state, scalars (empty where missing), problem.

    Numbers are written so that they read back exactly; units are in the header, in brackets.
    """
    sweep = table.sweep
    paths = list(dict.fromkeys(path for axis in sweep.axes for path in axis.parameters)) or sorted(
        {path for point in sweep.points for path in point}
    )
    heads = [f"{path} [{known_declaration(path).metadata['unit']}]" for path in paths]
    scalars = [f"{key} [{quantity.unit}]" for key, quantity in table.columns.items()]
    states = table.states().ravel()
    yield _line([*heads, STATE, *scalars, PROBLEM])
    for position in range(len(sweep)):
        given = sweep.numbers(position)
        values = ("" if value != value else repr(value) for value in table.values[position].tolist())
        yield _line(
            [
                *(repr(given[path]) if path in given else "" for path in paths),
                states[position],
                *values,
                table.problems.get(position, ""),
            ]
        )


def _line(cells: list[str]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(cells)
    return text.getvalue()
