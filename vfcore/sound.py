"""The sound of a run, worked out after it from its flow; of many runs only where they are measured."""

import numpy as np

from vfcore.acoustics.airways import tract_of
from vfcore.acoustics.impulse_response import radiate, response_at
from vfcore.errors import ParameterError
from vfcore.measures.signals import Sound, window_start
from vfcore.params import Simulation

LOOK_BACK_S = 0.020  # before the measured half, for slopes and minima at its edge; many times what they need


def measured_sound(request: Simulation, flow_m3_s: np.ndarray, sample_s: float, left_out: int = 0) -> Sound:
    """Sound of a run where it is measured, its last half: the whole sound bit for bit, and 0 before.

    ``left_out``: samples of the run before those of ``flow_m3_s`` (n,); at most ``unheard``.
    """
    start = window_start(len(flow_m3_s), left_out)
    heard = radiate(flow_m3_s, sample_s, tract_of(request), first=start, mouth_flow=False)
    silence = np.zeros(start)
    return Sound(np.concatenate((silence, heard.lip_pressure_pa)), np.concatenate((silence, heard.far_pressure_pa)))


def unheard(request: Simulation, samples: int, sample_s: float) -> int:
    """How many of the first of ``samples`` no measure looks at: what flows so early has left the lips before the last
    half begins. 0 where the tract rings without end.
    """
    try:
        history = response_at(tract_of(request), sample_s).shape[1]
    except ParameterError:
        return 0
    return max(0, window_start(samples) - max(history, round(LOOK_BACK_S / sample_s)))


def whole_sound(request: Simulation, flow_m3_s: np.ndarray, sample_s: float) -> Sound:
    """Sound of a run from its flow (n,), m³/s, bit for bit that of ``measured_sound`` in the last half."""
    start = window_start(len(flow_m3_s))
    sound = measured_sound(request, flow_m3_s, sample_s)
    before = radiate(flow_m3_s[:start], sample_s, tract_of(request), mouth_flow=False)
    sound.lip_pressure_pa[:start], sound.far_pressure_pa[:start] = before.lip_pressure_pa, before.far_pressure_pa
    return sound
