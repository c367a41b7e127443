"""A finished run as one netCDF-4 file: waveforms, one cycle of fields, measures, and the request that repeats it.

Variables: every array of ``vfcore.runs.result.ARRAYS`` under its name, float64; every measure as the scalar
``measure_<key>`` (NaN with a ``reason`` where there is none), with its error bar as ``error_half_width`` and
``error_limit`` where the request has an error estimate; posture and coefficients as ``posture_<name>`` and
``coefficient_<name>``, of two different folds the mean posture and the left fold, and both under
``side_posture_<name>`` and ``side_coefficient_<name>``. Attributes of the file: phonation state, provenance, and the
request as JSON.
"""

import io
import json
import os
from typing import Any

import numpy as np

from vfcore.io.atomic import replacing
from vfcore.io.hdf5 import Variable, write_variables
from vfcore.io.result_document import COEFFICIENTS, POSTURE, json_text, result_document
from vfcore.measures.catalogue import CATALOGUE
from vfcore.runs.result import ARRAYS, SimulationResult, dims_of
from vfcore.spec.declarations import SIDES
from vfcore.spec.fields import PAPER


def write_netcdf(result: SimulationResult, path: str | os.PathLike) -> None:
    """Write the file whole or not at all; OSError where ``path`` cannot be written."""
    with replacing(path) as draft:
        write_variables(draft, *_content(result))


def netcdf_bytes(result: SimulationResult) -> bytes:
    """The same file as bytes."""
    buffer = io.BytesIO()
    write_variables(buffer, *_content(result))
    return buffer.getvalue()


def request_of(attributes: Any) -> dict[str, Any]:
    """The request document from the attributes of a file, however it was opened."""
    return json.loads(attributes["request"])


def _content(result: SimulationResult) -> tuple[dict[str, Variable], dict[str, str | float]]:
    document = result_document(result)
    variables = {
        name: Variable(dims_of(name, array), array, {"units": ARRAYS[name].unit, "long_name": ARRAYS[name].label})
        for name, array in result.arrays.items()
    }
    for spec in CATALOGUE:
        variables[f"measure_{spec.key}"] = _measure(spec, document["measures"][spec.key], _bar_of(document, spec.key))
    variables["side"] = Variable(("side",), np.array(SIDES, object), {"long_name": "side of the patient"})
    each = [document["sides"][side] for side in SIDES] if "sides" in document else []
    for prefix, section, quantities in (("posture", "posture", POSTURE), ("coefficient", "coefficients", COEFFICIENTS)):
        for name, quantity in quantities.items():
            attributes = {"units": quantity.unit, "long_name": quantity.label}
            variables[f"{prefix}_{name}"] = Variable((), _number(document[section][name]), attributes)
            if each:
                values = np.array([_number(one[section][name]) for one in each])
                variables[f"side_{prefix}_{name}"] = Variable(("side",), values, attributes)
    provenance = document["provenance"]
    request = provenance.pop("request")
    about: dict[str, str | float] = {
        "title": "Vocalis simulation of a vocal fold",
        "source": f"Vocalis {provenance['code_version']}, model {provenance['model_version']}",
        "references": PAPER,
        "phonation_state": document["phonation_state"],
        "explanation": document["explanation"],
        "periodicity": float("nan") if document["periodicity"] is None else document["periodicity"],
        "cycles": document["cycles"],
        "cycle_is_complete": int(document["cycle_is_complete"]),
        "closure_pattern": document["static_shape"]["closure_pattern"],
        "closed_fraction": document["static_shape"]["closed_fraction"],
        **provenance,
        "request": json_text(request),
    }
    return variables, about


def _number(value: float | None) -> float:
    return float("nan") if value is None else float(value)


def _bar_of(document: dict[str, Any], key: str) -> dict[str, Any]:
    """Attributes that hold the error bar of a measure, where they were estimated (NaN with a reason for none)."""
    if document["error_estimate"] is None:
        return {}
    bar = document["error_estimate"]["measures"][key]
    if bar["half_width"] is None:
        return {"error_half_width": float("nan"), "error_reason": bar["reason"]}
    return {"error_half_width": bar["half_width"], "error_limit": bar["limit"]}


def _measure(spec, measure: dict[str, Any], bar: dict[str, Any]) -> Variable:
    attributes = {"units": measure["unit"], "long_name": spec.name, "symbol": spec.symbol} | bar
    if measure["value"] is None:
        return Variable((), float("nan"), attributes | {"reason": measure["reason"]})
    return Variable((), measure["value"], attributes)
