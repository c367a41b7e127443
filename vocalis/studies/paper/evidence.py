"""Evidence of the checks: plain arrays, extracted from the results of vfcore.

SI units. A measure that could not be computed is NaN.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vfcore.fold.statics import StaticShape
from vfcore.measures.catalogue import MeasureReport
from vfcore.runs.result import SimulationResult


class StaticSeries(NamedTuple):
    """Static shapes at n rising levels of one activation; w > 0 is medial, y = 0 superior, x = 0 anterior."""

    levels: np.ndarray  # (n,)
    x_m: np.ndarray  # (n, nx)
    y_m: np.ndarray  # (n, ny)
    w_m: np.ndarray  # (n, nx, ny) membrane
    w_b_m: np.ndarray  # (n, nx) beam
    medial_m: np.ndarray  # (n, nx, ny) medial plane G


class VoiceCycle(NamedTuple):
    """One run: phonation state, measures by key, static shape, and one cycle at p phases.

    ``repeats`` is False if the run has no trackable cycle; the cycle arrays then hold the last 10 ms.
    """

    state: str
    explanation: str
    repeats: bool
    measures: dict[str, float]
    x_m: np.ndarray  # (nx,)
    y_m: np.ndarray  # (ny,)
    medial_m: np.ndarray  # (nx, ny)
    static_w_m: np.ndarray  # (nx, ny)
    time_s: np.ndarray  # (p,)
    area_m2: np.ndarray  # (p,) minimum glottal area
    flow_m3_s: np.ndarray  # (p,)
    w_m: np.ndarray  # (p, nx, ny)
    aerodynamic_pa: np.ndarray  # (p, nx, ny)
    contact_pa: np.ndarray  # (p, nx, ny)


class ActivationMap(NamedTuple):
    """Measures over CT (first axis) and TA (second axis); all maps (n, m)."""

    ct: np.ndarray  # (n,)
    ta: np.ndarray  # (m,)
    state: np.ndarray  # phonation states, str
    fo_hz: np.ndarray
    mean_flow_ml_s: np.ndarray
    ac_flow_ml_s: np.ndarray
    spl_lips_db: np.ndarray
    speed_quotient: np.ndarray
    closed_quotient: np.ndarray


class PcaSweep(NamedTuple):
    """Contact over PCA activation; all (n,)."""

    pca: np.ndarray
    state: np.ndarray  # str
    contact_pressure_max_pa: np.ndarray
    contact_location: np.ndarray  # x/L


class Timing(NamedTuple):
    """Wall time of one warm call of ``vfcore.simulate`` for ``simulated_s`` of phonation."""

    simulated_s: float
    wall_s_paper_step: float
    wall_s_own_step: float


MAP_MEASURES = ActivationMap._fields[3:]
SWEEP_MEASURES = PcaSweep._fields[2:]


def static_series(levels: Sequence[float], shapes: Sequence[StaticShape]) -> StaticSeries:
    """A series from the static shapes of vfcore, one for each level."""
    return StaticSeries(
        np.asarray(levels, dtype=float),
        np.stack([s.x_m for s in shapes]),
        np.stack([s.y_m for s in shapes]),
        np.stack([s.w_m.T for s in shapes]),
        np.stack([s.w_b for s in shapes]),
        np.stack([s.medial_m.T for s in shapes]),
    )


def voice_cycle(result: SimulationResult) -> VoiceCycle:
    """The evidence of a run; waveforms at the phases of the stored cycle."""
    a = result.arrays
    at = a["cycle_time_s"]
    return VoiceCycle(
        result.report.state,
        result.report.explanation,
        result.cycle_is_complete,
        {key: value_of(result.report, key) for key in result.report.measures},
        a["x_m"],
        a["y_m"],
        a["medial_plane_m"],
        a["static_w_m"],
        at,
        np.interp(at, a["time_s"], a["glottal_area_m2"]),
        np.interp(at, a["time_s"], a["glottal_flow_m3_s"]),
        a["cycle_w_m"],
        a["cycle_aerodynamic_pressure_pa"],
        a["cycle_contact_pressure_pa"],
    )


def activation_map(ct: Sequence[float], ta: Sequence[float], reports: Sequence[MeasureReport]) -> ActivationMap:
    """A map from the reports of its runs, TA varying fastest."""
    shape = len(ct), len(ta)
    state, tables = _tables(reports, MAP_MEASURES)
    return ActivationMap(np.asarray(ct), np.asarray(ta), state.reshape(shape), *(t.reshape(shape) for t in tables))


def pca_sweep(pca: Sequence[float], reports: Sequence[MeasureReport]) -> PcaSweep:
    """A sweep from the reports of its runs."""
    state, tables = _tables(reports, SWEEP_MEASURES)
    return PcaSweep(np.asarray(pca), state, *tables)


def value_of(report: MeasureReport, key: str) -> float:
    """The value of a measure, NaN where there is none."""
    value = report.measures[key].value
    return float("nan") if value is None else float(value)


def _tables(reports: Sequence[MeasureReport], keys: Sequence[str]) -> tuple[np.ndarray, list[np.ndarray]]:
    return np.array([r.state for r in reports]), [np.array([value_of(r, key) for r in reports]) for key in keys]
