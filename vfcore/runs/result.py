"""The result of a run: posture, coefficients, waveforms, one cycle of fields, measures, provenance."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from vfcore.fold.statics import StaticShape
from vfcore.larynx.posture.solution import PostureSolution
from vfcore.larynx.tissue.coefficients import Coefficients
from vfcore.measures.catalogue import MeasureReport
from vfcore.runs.error_estimate import ErrorEstimate
from vfcore.runs.setup import mean_posture
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
    "left_edge_m": ArraySpec("m", ("time",), "edge of the left fold at mid-length, from the midline, positive lateral"),
    "right_edge_m": ArraySpec("m", ("time",), "the same of the right fold"),
    "cycle_time_s": ArraySpec("s", ("phase",), "time of each phase of the cycle"),
    "cycle_w_m": ArraySpec("m", ("phase", "x", "y"), "membrane displacement, positive medial"),
    "cycle_wb_m": ArraySpec("m", ("phase", "x"), "beam displacement, positive medial"),
    "cycle_edges_m": ArraySpec(
        "m", ("side", "phase", "x"), "medial edge of the left and the right fold from the midline, positive to the left"
    ),
    "cycle_aerodynamic_pressure_pa": ArraySpec("Pa", ("phase", "x", "y"), "aerodynamic pressure"),
    "cycle_contact_pressure_pa": ArraySpec("Pa", ("phase", "x", "y"), "contact pressure"),
}


#: Arrays that only two different folds have.
OF_TWO_WALLS = ("left_edge_m", "right_edge_m")


def dims_of(name: str, array: np.ndarray) -> tuple[str, ...]:
    """Dimensions of an array of a result: where the folds differ, what belongs to one has ``side`` first."""
    dims = ARRAYS[name].dims
    return dims if array.ndim == len(dims) else ("side", *dims)


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

    ``postures``, ``wall_coefficients`` and ``statics``: one of each wall of the glottis, the left fold first.
    ``arrays``: names of ARRAYS, float64, shapes by ``dims_of``. ``report``: phonation state,
    periodicity and measures. ``cycle_is_complete`` is False when nothing repeats; the cycle arrays then
    hold the last 10 ms of the run.
    """

    request: Simulation
    postures: tuple[PostureSolution, ...]
    wall_coefficients: tuple[Coefficients, ...]
    statics: tuple[StaticShape, ...]
    report: MeasureReport
    arrays: dict[str, np.ndarray]
    cycle_is_complete: bool
    provenance: Provenance
    error_estimate: ErrorEstimate | None = None  # of a request with ``run.error_estimate``

    @property
    def posture(self) -> PostureSolution:
        """The posture; of two different folds the mean of both."""
        return mean_posture(self.postures)

    @property
    def coefficients(self) -> Coefficients:
        """The coefficients of the fold; of two different ones the left."""
        return self.wall_coefficients[0]

    @property
    def static(self) -> StaticShape:
        """The static shape of the fold; of two different ones the left."""
        return self.statics[0]
