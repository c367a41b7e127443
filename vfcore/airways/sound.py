"""The sound of a run, worked out after it from its flow; of many runs only where they are measured."""

import numpy as np

from vfcore.airways.coupled import tract_of
from vfcore.airways.impulse_response import radiate, radiate_each
from vfcore.airways.tract import Tract
from vfcore.measures.signals import Sound, window_start
from vfcore.spec.simulation import Simulation


def measured_sound(request: Simulation, flow_m3_s: np.ndarray, sample_s: float, left_out: int = 0) -> Sound:
    """Sound of a run where it is measured, its last half: the whole sound bit for bit, and 0 before, without its first
    ``left_out`` samples.
    """
    flows = np.asarray(flow_m3_s, dtype=np.float64)[None]
    return measured_sounds(tract_of(request), flows, sample_s, left_out)[0]


def measured_sounds(tract: Tract, flows_m3_s: np.ndarray, sample_s: float, left_out: int = 0) -> list[Sound]:
    """The same of several runs of one tract, ``flows_m3_s`` (runs, n), in the precision these have."""
    start = window_start(flows_m3_s.shape[1])
    heard = radiate_each(flows_m3_s, sample_s, tract, first=start, mouth_flow=False)
    silence = np.zeros((len(flows_m3_s), start - left_out), flows_m3_s.dtype)
    waves = [np.concatenate((silence, wave), axis=1) for wave in (heard.lip_pressure_pa, heard.far_pressure_pa)]
    return [Sound(*of_run) for of_run in zip(*waves, strict=True)]


def whole_sound(request: Simulation, flow_m3_s: np.ndarray, sample_s: float) -> Sound:
    """Sound of a run from its flow (n,), m³/s, bit for bit that of ``measured_sound`` in the last half."""
    start = window_start(len(flow_m3_s))
    sound = measured_sound(request, flow_m3_s, sample_s)
    before = radiate(flow_m3_s[:start], sample_s, tract_of(request), mouth_flow=False)
    sound.lip_pressure_pa[:start], sound.far_pressure_pa[:start] = before.lip_pressure_pa, before.far_pressure_pa
    return sound
