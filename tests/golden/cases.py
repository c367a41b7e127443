"""The cases of the golden file: runs over the variants of the model, and the numbers stored for each."""

import json
import math
from pathlib import Path

import numpy as np

import vfcore
from vfcore.spec.request import resolve

STORED = Path(__file__).with_name("results.json")
#: Results on different machines differ by rounding only, and a periodic voice does not amplify it.
RELATIVE_TOLERANCE = 1e-6


def _muscles(lca, ia, pca, ct, ta):
    return {"activation": {"lca": lca, "ia": ia, "pca": pca, "ct": ct, "ta": ta}}


#: Irregular voices are short, because rounding errors grow in them.
CASES = {
    "modal": {},
    "modal, paper's step": {"run": {"duration_s": 0.3, "time_step_s": 0.0025 / 350 / 4}},
    "modal, finer grid, static start": {"run": {"nx": 30, "ny": 14, "duration_s": 0.5, "start": "static"}},
    "posterior opening": _muscles(0.8, 0.8, 0.5, 0.3, 0.4),
    "high pitch": _muscles(0.8, 0.8, 0.0, 1.0, 0.1) | {"vowel": "i"},
    "pressed": _muscles(1.0, 1.0, 0.0, 0.3, 0.6) | {"subglottal_pressure_pa": 1500},
    "other posturing set": {"model": {"posture_set": "alzamendi2020"}, "run": {"pressure_rise_s": 0.05}},
    "text to the letter": {"model": {"variant": "text_literal"}, "run": {"duration_s": 0.03}},
    "human, two-way": {"model": {"variant": "human", "coupling": "two_way"}, "subglottal_pressure_pa": 700},
    "posture given": {"posture": {"strain": 0.2, "glottal_half_angle_rad": 0.004}, "convergence_angle_rad": 0.05},
    "no phonation": _muscles(0.2, 0.2, 1.0, 0.1, 0.0) | {"subglottal_pressure_pa": 300},
}
MEASURES = (
    "fo_hz",
    "closed_quotient",
    "speed_quotient",
    "mean_flow_ml_s",
    "mfdr_l_s2",
    "h1_h2_flow_db",
    "contact_pressure_max_pa",
    "contact_location",
    "spl_lips_db",
)


def results_of(document: dict) -> dict:
    """State, closure and numbers (None where a measure is missing) of one request document."""
    result = vfcore.simulate(resolve({"kind": "simulation"} | document))
    numbers = {key: result.report.measures[key].value for key in MEASURES}
    numbers |= {
        "strain": result.posture.strain,
        "glottal_half_angle_rad": result.posture.glottal_half_angle_rad,
        "membrane_tension_n_m": result.coefficients.membrane_tension_n_m,
        "beam_tension_n": result.coefficients.beam_tension_n,
        "static_w_rms_m": _rms(result.arrays["static_w_m"]),
        "cycle_w_rms_m": _rms(result.arrays["cycle_w_m"]),
        "cycle_aerodynamic_pressure_rms_pa": _rms(result.arrays["cycle_aerodynamic_pressure_pa"]),
        "flow_rms_m3_s": _rms(result.arrays["glottal_flow_m3_s"]),
        "radiated_pressure_rms_pa": _rms(result.arrays["radiated_pressure_pa"]),
    }
    return {"state": result.report.state, "closure": result.static.closure.pattern, "numbers": numbers}


def differences(stored: dict, now: dict) -> list[str]:
    """One line per value that has changed; empty if none has."""
    lines = [f"{key} was {stored[key]}, is {now[key]}" for key in ("state", "closure") if stored[key] != now[key]]
    for key in sorted(stored["numbers"].keys() | now["numbers"].keys()):
        was, value = stored["numbers"].get(key), now["numbers"].get(key)
        if (was is None or value is None) and was is not value:
            lines.append(f"{key} was {was}, is {value}")
        elif was is not None and not math.isclose(was, value, rel_tol=RELATIVE_TOLERANCE, abs_tol=0.0):
            lines.append(f"{key} was {was:.9g}, is {value:.9g}")
    return lines


def read_stored(path: Path = STORED) -> dict:
    """The golden file: {"model_version", "reason", "cases": {name: {"request", "results"}}}."""
    return json.loads(path.read_text(encoding="utf-8"))


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))
