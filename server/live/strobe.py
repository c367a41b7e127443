"""Which moment of a block to look at, so that a fast vibration is seen slowly: a strobe locked to f_o."""

import math

import numpy as np

from vfcore.gesture.contours import WINDOW_S, pitch_hz
from vfcore.gesture.glide import STRETCH_STEPS
from vfcore.gesture.voice import BLOCK_S, BLOCK_STEPS
from vfcore.params import DEFAULT_STEP_S

SLOW_HZ = 1.5  # apparent cycles a second
THINNED = 4  # f_o is sought in every fourth sample: nothing of the area's shape is lost at 8.75 kHz
_MOMENTS = np.arange(STRETCH_STEPS, BLOCK_STEPS + 1, STRETCH_STEPS)
_WINDOW = round(WINDOW_S / DEFAULT_STEP_S)


class Strobe:
    """Follows f_o in the last 60 ms of glottal area and picks steps at which the phase moves on at SLOW_HZ."""

    def __init__(self) -> None:
        self._area = np.zeros(0)
        self.fo_hz = math.nan
        self._since_peak_s = 0.0
        self._phase = 0.0

    def moment(self) -> int:
        """The step of the next block, a multiple of STRETCH_STEPS, at which to look."""
        if math.isnan(self.fo_hz):
            return BLOCK_STEPS
        phases = (self._since_peak_s + _MOMENTS * DEFAULT_STEP_S) * self.fo_hz
        return int(_MOMENTS[np.abs((phases - self._phase + 0.5) % 1.0 - 0.5).argmin()])

    def follow(self, area_m2: np.ndarray, measure: bool) -> None:
        """Take a block's area; ``measure`` whether to look for f_o anew."""
        self._phase = (self._phase + SLOW_HZ * BLOCK_S) % 1.0
        self._area = np.concatenate([self._area, area_m2])[-_WINDOW:]
        if measure:
            self.fo_hz = pitch_hz(self._area[::-THINNED], 1.0 / (THINNED * DEFAULT_STEP_S))
        if not math.isnan(self.fo_hz):
            cycle = self._area[-math.ceil(1.0 / (self.fo_hz * DEFAULT_STEP_S)) :]
            self._since_peak_s = (len(cycle) - 1 - int(cycle.argmax())) * DEFAULT_STEP_S
