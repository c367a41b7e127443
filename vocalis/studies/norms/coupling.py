"""Effects of two-way coupling on a voice: vowels with both couplings, and a harmonic that crosses F1.

Also its robustness: random voices over the whole range, and the same at half the step.
"""

from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, replace
from typing import Any, NamedTuple

import numpy as np

from vfcore.airways.coupled import Airways, airways
from vfcore.airways.resonances import closed_glottis_formants
from vfcore.airways.tract import Tract
from vfcore.errors import DivergenceError, VocalisError
from vfcore.fold.march import TimeMarch
from vfcore.fold.stability import time_step_s
from vfcore.runs.one import simulate
from vfcore.runs.result import SimulationResult
from vfcore.runs.setup import prepare
from vfcore.spec.request import resolve
from vfcore.spec.simulation import DEFAULT_STEP_S, Simulation
from vocalis.studies.norms.efforts import POSTURE
from vocalis.studies.paper.evidence import value_of

VOWELS = ("a", "i", "u")
#: The voices compared: the paper's constants at a pressure that gives an opening of human size, and the human variant.
VOICES = (("paper", 300.0), ("human", 700.0))
#: Area of a uniform tube in place of a vowel; its length follows from F1.
TUBE_AREA_M2 = 3e-4
TUBE_F1_HZ = (700, 600, 550, 500, 475, 450, 400, 350, 300, 275, 250, 225, 200)
RANDOM_VOICES, RANDOM_RUN_S, HALVED = 500, 0.2, 40
SEED = 20261125


class Pair(NamedTuple):
    """One voice with both couplings."""

    variant: str
    vowel: str
    one_way: SimulationResult
    two_way: SimulationResult


def pairs() -> list[Pair]:
    """The modal posture, each of VOICES and VOWELS, with both couplings."""
    return [
        Pair(variant, vowel, *(_voice(variant, pressure, vowel, way) for way in ("one_way", "two_way")))
        for variant, pressure in VOICES
        for vowel in VOWELS
    ]


def _voice(variant: str, pressure_pa: float, vowel: str, coupling: str) -> SimulationResult:
    model = {"variant": variant, "coupling": coupling}
    return simulate(resolve({"model": model, "vowel": vowel, "subglottal_pressure_pa": pressure_pa}))


def effects(result: SimulationResult) -> dict[str, Any]:
    """State, f_o, flow and level; ``skew``: delay of the flow peak after the area peak, in cycles."""
    keys = ("fo_hz", "ac_flow_ml_s", "mfdr_l_s2", "spl_30cm_db", "peak_area_mm2")
    measured = {key: result.report.measures[key].value for key in keys}
    bounds = result.report.cycle_bounds
    skew = None
    if result.report.state == "periodic" and bounds:
        cycle = slice(*bounds)
        area, flow = (result.arrays[name][cycle] for name in ("glottal_area_m2", "glottal_flow_m3_s"))
        apart = (int(flow.argmax()) - int(area.argmax())) / len(area)
        skew = (apart + 0.5) % 1.0 - 0.5
    return {"state": result.report.state, **measured, "skew": skew}


def fo_over_f1(pressure_pa: float = 800.0) -> list[dict[str, float]]:
    """f_o of the human voice in the posture of the norms, under uniform tubes of falling F1."""
    base = resolve({"model": {"variant": "human", "coupling": "two_way"}, "activation": asdict(POSTURE)})
    glottis = prepare(base).glottis
    air = base.constants
    below = airways("a", air.rho_a_kg_m3, air.c_a_m_s, DEFAULT_STEP_S)
    section = below.supraglottal.section_length_m
    rows = []
    for f1 in TUBE_F1_HZ:
        tube = Tract((TUBE_AREA_M2,) * round(air.c_a_m_s / (4 * f1) / section), section)
        march = TimeMarch(glottis, DEFAULT_STEP_S, pressure_pa, 0.0, Airways(below.subglottal, tube, below.substeps))
        march.start(0, None)
        area = march.run(round(0.6 / DEFAULT_STEP_S))[:, 0]
        rows.append({"f1_hz": float(closed_glottis_formants(tube, 1).frequency_hz[0]), "fo_hz": _rate(area)})
    return rows


def _rate(area_m2: np.ndarray) -> float:
    """Repetition rate of the last half of an area waveform at the default step, Hz, from its autocorrelation."""
    wave = area_m2[len(area_m2) // 2 :] - area_m2[len(area_m2) // 2 :].mean()
    spectrum = np.abs(np.fft.rfft(wave, 2 * len(wave))) ** 2
    correlation = np.fft.irfft(spectrum)[: len(wave) // 4]
    shortest = round(1 / 400 / DEFAULT_STEP_S)
    peak = shortest + int(correlation[shortest:].argmax())
    before, at, after = correlation[peak - 1 : peak + 2]
    return float(1 / DEFAULT_STEP_S / (peak + (before - after) / (2 * (before - 2 * at + after))))


def random_voices(variant: str, count: int = RANDOM_VOICES) -> list[Simulation]:
    """Two-way coupled requests with activations, pressure (200 to 2000 Pa) and vowel drawn at random."""
    rng = np.random.default_rng(SEED)
    requests = []
    for _ in range(count):
        muscles = dict(zip(("ta", "ct", "lca", "ia", "pca"), rng.uniform(0, 1, 5).tolist(), strict=True))
        muscles["pca"] *= 0.5 * rng.uniform() ** 2  # most postures adducted: open ones do not vibrate
        requests.append(
            resolve(
                {
                    "model": {"variant": variant, "coupling": "two_way"},
                    "activation": muscles,
                    "subglottal_pressure_pa": float(rng.uniform(200, 2000)),
                    "vowel": str(rng.choice(["i", "e", "AE", "a", "o", "u"])),
                    "run": {"duration_s": RANDOM_RUN_S},
                }
            )
        )
    return requests


def state_of(request: Simulation) -> str:
    """The phonation state of a run, "diverged" or "no posture"; runs in a worker."""
    try:
        return simulate(request).report.state
    except DivergenceError:
        return "diverged"
    except VocalisError:
        return "no posture"


def halved(request: Simulation) -> tuple[float, float] | None:
    """Relative change of f_o and peak area at half the step; None unless both runs are periodic."""
    usual = simulate(request)
    step = time_step_s(request.run, prepare(request).glottis)
    fine = simulate(replace(request, run=replace(request.run, time_step_s=step / 2)))
    if {usual.report.state, fine.report.state} != {"periodic"}:
        return None
    fo, area = (value_of(fine.report, key) / value_of(usual.report, key) - 1 for key in ("fo_hz", "peak_area_mm2"))
    return fo, area


def robustness(variant: str, pool: ProcessPoolExecutor, count: int = RANDOM_VOICES) -> dict[str, Any]:
    """States of the random voices, and the change of the first periodic ones at half the step."""
    requests = random_voices(variant, count)
    states = list(pool.map(state_of, requests, chunksize=5))
    periodic = [request for request, state in zip(requests, states, strict=True) if state == "periodic"][:HALVED]
    moved = [pair for pair in pool.map(halved, periodic) if pair is not None]
    sizes = np.abs(np.array(moved)).reshape(-1, 2)
    return {
        "voices": count,
        "outcomes": {state: states.count(state) for state in sorted(set(states))},
        "halved": len(moved),
        "fo_moved": [float(v) for v in np.percentile(sizes[:, 0], (50, 90))] if len(moved) else [],
        "area_moved": [float(v) for v in np.percentile(sizes[:, 1], (50, 90))] if len(moved) else [],
    }
