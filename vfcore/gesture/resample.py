"""From the step's 35 kHz to the 48 kHz of sound cards, block by block, with the filter of ``vfcore.audio``."""

from fractions import Fraction

import numpy as np

from vfcore.audio import AUDIO_RATE_HZ, low_pass
from vfcore.errors import ParameterError


class Resampler:
    """A causal polyphase filter with memory: joined blocks equal the resampled whole, ``delay_s`` late."""

    def __init__(self, sample_rate_hz: float, block: int):
        ratio = Fraction(AUDIO_RATE_HZ / sample_rate_hz).limit_denominator(1000)
        self._up, self._down = ratio.numerator, ratio.denominator
        if block * self._up % self._down:
            raise ParameterError("block", f"{block} samples make no whole number at {AUDIO_RATE_HZ} Hz", "350")
        self._filter = low_pass(self._up, float(min(1, ratio))) * self._up
        taps = -(-len(self._filter) // self._up)
        self._memory = np.zeros(-(-taps // self._down) * self._down)
        self._out = block * self._up // self._down
        self.delay_s = 0.5 * (len(self._filter) - 1) / (self._up * sample_rate_hz)

    def push(self, block: np.ndarray) -> np.ndarray:
        """The next audio samples for one block."""
        from scipy.signal import upfirdn  # half a second to import: only once there is sound to make

        joined = np.concatenate([self._memory, block])
        skip = len(self._memory) * self._up // self._down
        self._memory = joined[-len(self._memory) :]
        return upfirdn(self._filter, joined, self._up, self._down)[skip : skip + self._out]
