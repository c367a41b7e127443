"""Results as plain values for JSON: what the command line prints and the server answers.

One shape for both. Keys carry units. A number that is not finite becomes null with a reason (a
measure's own ``reason``, otherwise ``null_reasons`` by dotted path), so that every document is strict JSON.
"""

import dataclasses
import json
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from vfcore.fold.statics import StaticShape
from vfcore.larynx.posture.solution import PostureSolution
from vfcore.larynx.tissue.coefficients import Coefficients
from vfcore.measures.measure import Measure
from vfcore.runs.error_estimate import METHOD
from vfcore.runs.result import ARRAYS, SimulationResult, dims_of
from vfcore.runs.setup import GlottisSetup
from vfcore.spec.declarations import SIDES
from vfcore.spec.request import document_of

ARRAY_DTYPE = "float32"  # as bytes in answers; files and Python hold float64


class Quantity(NamedTuple):
    """What a number of a document is: unit, the paper's symbol, plain name."""

    unit: str
    symbol: str
    label: str


POSTURE = {
    "strain": Quantity("1", "ε̄", "nominal fold strain"),
    "glottal_half_angle_rad": Quantity("rad", "θ_g", "glottal half-angle"),
    "raw_glottal_half_angle_rad": Quantity("rad", "", "glottal half-angle before it is clipped at 0"),
    "length_m": Quantity("m", "L", "fold length"),
    "residual": Quantity("1", "", "residual of the posturing equations, of the load scale"),
    "converged": Quantity("1", "", "whether the posturing equations are solved"),
}
COEFFICIENTS = {
    "membrane_tension_n_m": Quantity("N m-1", "T̃_m", "membrane tension"),
    "beam_tension_n": Quantity("N", "Ñ_b", "beam tension"),
    "bending_stiffness_n_m2": Quantity("N m2", "μ̃_c", "bending stiffness"),
    "prestress_moment_n_m": Quantity("N m", "M̄_c", "prestress moment"),
    "membrane_density_kg_m2": Quantity("kg m-2", "ρ_s", "membrane mass per area"),
    "beam_density_kg_m": Quantity("kg m-1", "ρ_l", "beam mass per length"),
}
_NOT_FINITE = "The computed value is not a finite number."


def posture_document(setup: GlottisSetup) -> dict[str, Any]:
    """Posture, coefficients and static shape of a request that has not been run."""
    return without_gaps(
        {
            "posture": _posture(setup.posture),
            "coefficients": _coefficients(setup.fold.coefficients),
            "static_shape": _static_shape(setup.static),
        }
        | _sides(setup.postures, [wall.coefficients for wall in setup.glottis.walls], setup.statics)
    )


def result_document(result: SimulationResult) -> dict[str, Any]:
    """Everything about a finished run; of the arrays only shape, unit and dimensions."""
    report = result.report
    document: dict[str, Any] = {
        "kind": "simulation",
        "phonation_state": report.state,
        "explanation": report.explanation,
        "periodicity": report.periodicity,
        "cycles": report.cycles,
        "cycle_is_complete": result.cycle_is_complete,
        "measures": {key: measure_document(measure) for key, measure in report.measures.items()},
        "error_estimate": _error_estimate(result),
        "posture": _posture(result.posture),
        "coefficients": _coefficients(result.coefficients),
        "static_shape": _static_shape(result.static),
        **_sides(result.postures, result.wall_coefficients, result.statics),
        "arrays": {
            name: {
                "shape": list(array.shape),
                "dtype": ARRAY_DTYPE,
                "unit": ARRAYS[name].unit,
                "dims": list(dims_of(name, array)),
            }
            for name, array in result.arrays.items()
        },
        "provenance": dataclasses.asdict(result.provenance) | {"request": document_of(result.request)},
    }
    document = without_gaps(document)
    if report.periodicity is None:
        document["null_reasons"]["periodicity"] = report.explanation
    return document


def json_text(document: Any, indent: int | None = None) -> str:
    """Strict JSON text (no NaN, no Infinity); ValueError for a document that is not plain."""
    return json.dumps(document, allow_nan=False, ensure_ascii=False, indent=indent)


def _sides(
    postures: Sequence[PostureSolution], coefficients: Sequence[Coefficients], statics: Sequence[StaticShape]
) -> dict[str, Any]:
    """Posture, coefficients and static shape of each side, under ``sides``, where the folds differ."""
    if len(postures) == 1:
        return {}
    each = zip(SIDES, postures, coefficients, statics, strict=True)
    return {
        "sides": {
            side: {"posture": _posture(one), "coefficients": _coefficients(c), "static_shape": _static_shape(shape)}
            for side, one, c, shape in each
        }
    }


def _posture(posture: PostureSolution) -> dict[str, Any]:
    return {name: getattr(posture, name) for name in POSTURE}


def _coefficients(coefficients: Coefficients) -> dict[str, float]:
    return {name: getattr(coefficients, name) for name in COEFFICIENTS}


def _static_shape(shape: StaticShape) -> dict[str, Any]:
    """Displacements (positive medial) and the medial plane along x, at the superior and inferior edge, m."""
    return {
        "x_m": shape.x_m.tolist(),
        "superior_m": shape.w_m[0].tolist(),
        "inferior_m": shape.w_m[-1].tolist(),
        "beam_m": shape.w_b.tolist(),
        "medial_superior_m": shape.medial_m[0].tolist(),
        "medial_inferior_m": shape.medial_m[-1].tolist(),
        "closed_fraction": shape.closure.closed_fraction,
        "closure_pattern": shape.closure.pattern,
    }


def measure_document(measure: Measure) -> dict[str, Any]:
    """A measure as the API has it: value, unit, and the reason where there is no value."""
    if measure.value is None or math.isfinite(measure.value):
        return dataclasses.asdict(measure)
    return {"value": None, "unit": measure.unit, "reason": measure.reason or _NOT_FINITE}


def _error_estimate(result: SimulationResult) -> dict[str, Any] | None:
    """Method, the runs compared, and per measure its bar in the measure's unit; None where not estimated."""
    estimate = result.error_estimate
    if estimate is None:
        return None
    return {
        "method": METHOD,
        "levels": [level._asdict() for level in estimate.levels],
        "measures": {
            key: dataclasses.asdict(bar) | {"unit": result.report.measures[key].unit}
            for key, bar in estimate.bars.items()
        },
    }


def without_gaps(document: dict[str, Any]) -> dict[str, Any]:
    """The document with numpy scalars as Python's, non-finite numbers as null and their paths in ``null_reasons``."""
    reasons: dict[str, str] = {}

    def plain(value, path: str):
        if isinstance(value, dict):
            return {key: plain(item, f"{path}.{key}" if path else key) for key, item in value.items()}
        if isinstance(value, list):
            return [plain(item, f"{path}.{k}") for k, item in enumerate(value)]
        if isinstance(value, np.generic):
            value = value.item()
        if isinstance(value, float) and not math.isfinite(value):
            reasons[path] = _NOT_FINITE
            return None
        return value

    return plain(document, "") | {"null_reasons": reasons}
