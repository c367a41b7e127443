"""The paper's figures as one plain document with the layout of the server's answers, so that the page draws shipped and
computed data with the same functions.

A figure has ``base`` and ``axes`` like a sweep, the claims it shows, and by ``kind``:
static: ``shapes``, the posture call's static shape at each level; voice: ``result`` header and ``arrays``, as of
POST /simulate; map and sweep: ``states`` and ``measures``, the last axis fastest.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from vfcore.errors import VocalisError
from vfcore.io.result_document import posture_document, result_document
from vfcore.measures.catalogue import MeasureReport
from vfcore.runs.one import simulate
from vfcore.runs.result import ARRAYS, SimulationResult
from vfcore.runs.setup import prepare
from vfcore.spec.request import document_of
from vfcore.spec.simulation import Simulation
from vocalis.studies.paper.cases import CASES, Case
from vocalis.studies.paper.claims.registry import CLAIMS
from vocalis.studies.paper.evidence import MAP_MEASURES, SWEEP_MEASURES
from vocalis.studies.paper.voicing import MAX_BELOW_MEDIAN_DB, MIN_AC_OVER_MEAN

#: Arrays of a voice that the page draws: the cycle at every fourth phase, the waves at the end of the run.
WAVES = ("radiated_pressure_pa", "glottal_flow_m3_s", "glottal_area_m2", "contact_pressure_max_pa")
GRID = ("medial_plane_m", "x_m", "y_m")
CYCLE = ("cycle_time_s", "cycle_w_m", "cycle_aerodynamic_pressure_pa", "cycle_contact_pressure_pa")
PHASE_STRIDE = 4
WAVES_S = 0.06
#: Significant digits: finer than a pixel of any picture.
DIGITS = 4
HEADER = ("phonation_state", "explanation", "periodicity", "cycles", "cycle_is_complete", "measures", "static_shape")
MEASURES = {"map": MAP_MEASURES, "sweep": SWEEP_MEASURES}
FAILED = "failed"


def figure_cases() -> dict[str, Case]:
    """The cases that have figures."""
    return {key: case for key, case in CASES.items() if case.kind != "timing"}


def answer(kind: str, request: Simulation) -> dict[str, Any]:
    """The data of one run for a figure of ``kind``; for a run without an answer, the reason as ``problem``."""
    try:
        if kind == "static":
            return posture_document(prepare(request))["static_shape"]
        result = simulate(request)
    except VocalisError as error:
        return {"problem": str(error)}
    return _voice(result) if kind == "voice" else _point(result.report, MEASURES[kind])


def figure(case: Case, answers: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """The figure of ``case`` from the answers to its requests, in order."""
    head = {
        "key": case.key,
        "kind": case.kind,
        "title": case.title,
        "claims": [claim.key for claim in CLAIMS.values() if case.key in claim.needs],
        "base": _changed(case),
        "axes": [
            {"parameter": [f"activation.{m}" for m in axis.muscles], "values": [round(v, 6) for v in axis.levels]}
            for axis in case.axes
        ],
    }
    if case.kind == "static":
        return head | {"shapes": [_rounded(shape) for shape in answers]}
    if case.kind == "voice":
        return head | _rounded(answers[0])
    keys = MEASURES[case.kind]
    tables = {key: [_rounded(one.get("measures", {}).get(key)) for one in answers] for key in keys}
    head |= {"measures": tables, "states": [one.get("state", FAILED) for one in answers]}
    if case.kind == "map":
        head["voicing"] = {"min_ac_over_mean": MIN_AC_OVER_MEAN, "max_below_median_db": MAX_BELOW_MEDIAN_DB}
    return head


def _changed(case: Case) -> dict[str, Any]:
    """The complete request of the case, without the values that its axes set."""
    request = document_of(case.requests()[0])
    moved = {m for axis in case.axes for m in axis.muscles}
    request["activation"] = {m: v for m, v in request["activation"].items() if m not in moved}
    return request


def _point(report: MeasureReport, keys: Sequence[str]) -> dict[str, Any]:
    return {"state": str(report.state), "measures": {key: report.measures[key].value for key in keys}}


def _voice(result: SimulationResult) -> dict[str, Any]:
    document = result_document(result)
    header = {key: document[key] for key in HEADER}
    header["provenance"] = {key: document["provenance"][key] for key in ("sample_rate_hz", "time_step_s")}
    samples = len(result.arrays["time_s"])
    # The waves end with the stored cycle, as on the page.
    last = min(samples, round(_cycle_end_s(result) * result.provenance.sample_rate_hz) + 2)
    first = max(0, last - round(WAVES_S * result.provenance.sample_rate_hz))
    cut = {name: result.arrays[name][first:last] for name in WAVES}
    cut |= {name: result.arrays[name] for name in GRID}
    cut |= {name: result.arrays[name][::PHASE_STRIDE] for name in CYCLE}
    arrays = {
        name: {"shape": list(a.shape), "unit": ARRAYS[name].unit, "data": a.ravel().tolist()} for name, a in cut.items()
    }
    # Times stay exact, since their differences are small.
    return {"result": header, "start_s": first / result.provenance.sample_rate_hz, "arrays": arrays}


def _cycle_end_s(result: SimulationResult) -> float:
    times = result.arrays["cycle_time_s"]
    return float(times[-1] + (times[1] - times[0]))


def _rounded(value: Any, name: str = "") -> Any:
    """Floats to DIGITS significant figures, None if not finite; times and rates unchanged."""
    if isinstance(value, dict):
        return {key: _rounded(item, name if key == "data" else key) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_rounded(item, name) for item in value]
    if not isinstance(value, (float, np.floating)):
        return value
    if not np.isfinite(value):
        return None
    return float(value) if name in ("cycle_time_s", "start_s", "sample_rate_hz") else float(f"{value:.{DIGITS}g}")
