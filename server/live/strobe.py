"""A strobe locked to f_o: it chooses the moment of each picture so that a fast vibration appears slow."""

import math

import numpy as np

from vfcore.runs.gesture.contours import WINDOW_S, pitch_hz
from vfcore.runs.gesture.glide import STRETCH_STEPS
from vfcore.runs.gesture.voice import BLOCK_STEPS
from vfcore.spec.simulation import DEFAULT_STEP_S

SLOW_HZ = 1.5  # apparent cycles a second
THINNED = 3  # f_o is found from every third sample: 9.3 kHz is enough for the shape of the area
_MOMENTS = np.arange(STRETCH_STEPS, BLOCK_STEPS + 1, STRETCH_STEPS)
_WINDOW = round(WINDOW_S / DEFAULT_STEP_S)


class Strobe:
    """Follows f_o in the last 60 ms of glottal area and picks steps at which the phase moves on at SLOW_HZ."""

    def __init__(self) -> None:
        self.fo_hz = math.nan
        self._phase = 0.0

    def moment(self, area_m2: np.ndarray, since_s: float) -> int:
        """The step of the next block, a multiple of STRETCH_STEPS, at which to look.

        ``area_m2``: glottal area of the last blocks; ``since_s``: the time since the last look.
        """
        self._phase = (self._phase + SLOW_HZ * since_s) % 1.0
        area = area_m2[-_WINDOW:]
        self.fo_hz = pitch_hz(np.ascontiguousarray(area[::-THINNED]), 1.0 / (THINNED * DEFAULT_STEP_S))
        if math.isnan(self.fo_hz):
            return BLOCK_STEPS
        cycle = area[-math.ceil(1.0 / (self.fo_hz * DEFAULT_STEP_S)) :]
        since_peak_s = (len(cycle) - 1 - int(cycle.argmax())) * DEFAULT_STEP_S
        phases = (since_peak_s + _MOMENTS * DEFAULT_STEP_S) * self.fo_hz
        return int(_MOMENTS[np.abs((phases - self._phase + 0.5) % 1.0 - 0.5).argmin()])
