"""The sound of a run, computed after it from its flow; of many runs only in their measured part."""

import numpy as np

from vfcore.airways.coupled import tract_of
from vfcore.airways.impulse_response import pressures_of_each
from vfcore.airways.tract import Tract
from vfcore.measures.signals import Sound, window_start
from vfcore.spec.simulation import Simulation


def measured_sound(request: Simulation, flow_m3_s: np.ndarray, sample_s: float, left_out: int = 0) -> Sound:
    """Sound of a run in its measured part, the last half, bit for bit that of the whole run, and 0 before.

    ``flow_m3_s``: shape (n,), m³/s, every ``sample_s``. ``left_out``: how many of the first samples the waves lack.
    ParameterError for a flow that is not finite.
    """
    return measured_sounds(tract_of(request), _alone(flow_m3_s), sample_s, left_out)[0]


def measured_sounds(tract: Tract, flows_m3_s: np.ndarray, sample_s: float, left_out: int = 0) -> list[Sound]:
    """The same of several runs of one tract, ``flows_m3_s`` (runs, n), in the precision these have."""
    start = window_start(flows_m3_s.shape[1])
    silence = np.zeros((len(flows_m3_s), start - left_out), flows_m3_s.dtype)
    pressures = pressures_of_each(flows_m3_s, sample_s, tract, first=start)
    waves = [np.concatenate((silence, wave), axis=1) for wave in pressures]
    return [Sound(*of_run) for of_run in zip(*waves, strict=True)]


def whole_sound(request: Simulation, flow_m3_s: np.ndarray, sample_s: float) -> Sound:
    """Sound of a run from its flow (n,), m³/s, bit for bit that of ``measured_sound`` in the last half."""
    start = window_start(len(flow_m3_s))
    sound = measured_sound(request, flow_m3_s, sample_s)
    before = pressures_of_each(_alone(flow_m3_s[:start]), sample_s, tract_of(request))
    sound.lip_pressure_pa[:start], sound.far_pressure_pa[:start] = before.lip_pressure_pa[0], before.far_pressure_pa[0]
    return sound


def _alone(flow_m3_s: np.ndarray) -> np.ndarray:
    """One flow as a row, (1, n), float64."""
    return np.asarray(flow_m3_s, dtype=np.float64)[None]
