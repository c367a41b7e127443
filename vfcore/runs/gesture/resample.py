"""Resampling from the step's 28 kHz to the 48 kHz of sound cards, block by block, with the filter of
``vfcore.io.audio``.
"""

from fractions import Fraction

import numpy as np

from vfcore.errors import ParameterError
from vfcore.io.audio import AUDIO_RATE_HZ, low_pass
from vfcore.kernels.polyphase import filter_and_resample, resample
from vfcore.runs.gesture.tract_filter import TractResponse


class Resampler:
    """A causal polyphase filter with memory: its blocks, joined, equal the resampled whole, delayed by ``delay_s``."""

    def __init__(self, sample_rate_hz: float, block: int):
        ratio = Fraction(AUDIO_RATE_HZ / sample_rate_hz).limit_denominator(1000)
        self._up, self._down = ratio.numerator, ratio.denominator
        if block * self._up % self._down:
            raise ParameterError("block", f"{block} samples are not a whole number at {AUDIO_RATE_HZ} Hz", "280")
        taps = low_pass(self._up, min(1.0, float(ratio))) * self._up
        reach = -(-len(taps) // self._up)
        padded = np.zeros(reach * self._up)
        padded[: len(taps)] = taps
        # Branch p holds every up-th tap from p on, in reverse: the order of the samples it multiplies.
        self._branches = np.ascontiguousarray(padded.reshape(reach, self._up).T[:, ::-1])
        self._samples = np.zeros(reach - 1 + block)
        self._out = block * self._up // self._down
        self.delay_s = 0.5 * (len(taps) - 1) / (self._up * sample_rate_hz)

    def push(self, block: np.ndarray) -> np.ndarray:
        """The next audio samples for one block."""
        audio = self.empty()
        resample(block, self._samples, self._branches, self._down, audio)
        return audio

    def push_through(self, flow: np.ndarray, tract: TractResponse, lip: np.ndarray, audio: np.ndarray) -> None:
        """Filter ``flow`` through a tract and resample the result in one call; fills ``lip`` (block,) and ``audio``."""
        filter_and_resample(
            flow, tract.memory[0], tract.backward[0], self._samples, self._branches, self._down, lip, audio
        )

    def empty(self) -> np.ndarray:
        """An uninitialised array for the audio of one block."""
        return np.empty(self._out)
