"""The result of a run: posture, coefficients, waveforms, one cycle of fields, measures, provenance."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from vfcore.fold.statics import StaticShape
from vfcore.larynx.posture.solution import PostureSolution
from vfcore.larynx.tissue.coefficients import Coefficients
from vfcore.measures.catalogue import MeasureReport
from vfcore.runs.error_estimate import ErrorEstimate
from vfcore.spec.simulation import Simulation


class ArraySpec(NamedTuple):
    """Name, unit, dimensions and plain description of one array of a result."""

    unit: str
    dims: tuple[str, ...]
    label: str


#: Every array a result carries, in the order in which files list them.
ARRAYS: dict[str, ArraySpec] = {
    "time_s": ArraySpec("s", ("time",), "time"),
    "glottal_area_m2": ArraySpec("m2", ("time",), "minimum glottal area"),
    "glottal_flow_m3_s": ArraySpec("m3 s-1", ("time",), "glottal volume flow"),
    "radiated_pressure_pa": ArraySpec("Pa", ("time",), "radiated pressure at the lips"),
    "far_pressure_pa": ArraySpec("Pa", ("time",), "free-field pressure at 0.3 m"),
    "contact_pressure_max_pa": ArraySpec("Pa", ("time",), "largest contact pressure"),
    "contact_location": ArraySpec("1", ("time",), "x/L of the largest contact pressure (NaN: no contact)"),
    "contact_area_m2": ArraySpec("m2", ("time",), "area of the medial surface in contact"),
    "inlet_pressure_pa": ArraySpec("Pa", ("time",), "pressure just below the glottis"),
    "outlet_pressure_pa": ArraySpec("Pa", ("time",), "pressure just above the glottis"),
    "x_m": ArraySpec("m", ("x",), "longitudinal coordinate, 0 anterior"),
    "y_m": ArraySpec("m", ("y",), "inferior-superior coordinate, 0 superior"),
    "medial_plane_m": ArraySpec("m", ("x", "y"), "medial plane G in the fold frame"),
    "static_w_m": ArraySpec("m", ("x", "y"), "static membrane displacement"),
    "static_wb_m": ArraySpec("m", ("x",), "static beam displacement"),
    "cycle_time_s": ArraySpec("s", ("phase",), "time of each phase of the cycle"),
    "cycle_w_m": ArraySpec("m", ("phase", "x", "y"), "membrane displacement, positive medial"),
    "cycle_wb_m": ArraySpec("m", ("phase", "x"), "beam displacement, positive medial"),
    "cycle_aerodynamic_pressure_pa": ArraySpec("Pa", ("phase", "x", "y"), "aerodynamic pressure"),
    "cycle_contact_pressure_pa": ArraySpec("Pa", ("phase", "x", "y"), "contact pressure"),
}


@dataclass(frozen=True, slots=True)
class Provenance:
    """What produced this result, enough to repeat it."""

    model_version: str
    code_version: str
    numba_version: str
    numpy_version: str
    created: str  # ISO 8601, UTC
    time_step_s: float
    sample_rate_hz: float
    kernel_seconds: float


@dataclass(frozen=True, slots=True, eq=False)
class SimulationResult:
    """One finished run.

    ``arrays``: every name of ARRAYS, float64, shapes by its dims. ``report``: phonation state,
    periodicity and measures. ``cycle_is_complete`` is False when nothing repeats; the cycle arrays then
    hold the last 10 ms of the run.
    """

    request: Simulation
    posture: PostureSolution
    coefficients: Coefficients
    static: StaticShape
    report: MeasureReport
    arrays: dict[str, np.ndarray]
    cycle_is_complete: bool
    provenance: Provenance
    error_estimate: ErrorEstimate | None = None  # of a request with ``run.error_estimate``
