"""The tract, block by block: a running convolution that changes its vowel without a seam.

A new vowel does not replace the filter: over one block the glottal flow is faded out of the old tract and into the new
one, and the old one rings to its end. Both are linear, so nothing clicks.
"""

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

from vfcore.acoustics.impulse_response import response_at
from vfcore.acoustics.tract import Tract

#: Energy of the response that is left out: 80 dB below the voice.
LEFT_OUT_ENERGY = 1e-8


class _Filter:
    """Overlap-add with one tract's response; the rows are lip pressure and pressure at 0.3 m."""

    def __init__(self, tract: Tract, time_step_s: float, block: int):
        lip, _, far = response_at(tract, time_step_s)
        energy = np.cumsum(lip * lip)
        taps = int(np.searchsorted(energy, (1.0 - LEFT_OUT_ENERGY) * energy[-1])) + 1
        self.tract, self._block = tract, block
        self._length = next_fast_len(block + taps - 1, real=True)
        self._spectra = rfft(np.stack([lip[:taps], far[:taps]]), self._length)
        self._tail = np.zeros((2, self._length))
        self.silent_blocks_left = -(-self._length // block)

    def push(self, flow: np.ndarray | None) -> np.ndarray:
        """The next block of sound (2, block), Pa; without flow the tract rings on."""
        if flow is not None:
            self._tail += irfft(rfft(flow, self._length) * self._spectra, self._length)
        else:
            self.silent_blocks_left -= 1
        out = self._tail[:, : self._block].copy()
        self._tail[:, : -self._block] = self._tail[:, self._block :]
        self._tail[:, -self._block :] = 0.0
        return out


class Lips:
    """Sound of a glottal flow that comes in blocks of ``block`` samples."""

    def __init__(self, tract: Tract, time_step_s: float, block: int):
        self._time_step_s, self._block = time_step_s, block
        self._now = _Filter(tract, time_step_s, block)
        self._ringing: list[_Filter] = []
        self._fade_in = (np.arange(block) + 0.5) / block

    def push(self, flow_m3_s: np.ndarray, tract: Tract) -> np.ndarray:
        """Lip pressure and pressure at 0.3 m, Pa, (2, block), for one block of flow."""
        if tract == self._now.tract:
            sound = self._now.push(flow_m3_s)
        else:
            old, self._now = self._now, _Filter(tract, self._time_step_s, self._block)
            self._ringing.append(old)
            sound = self._now.push(flow_m3_s * self._fade_in)
            sound += old.push(flow_m3_s * (1.0 - self._fade_in))
            for ringing in self._ringing[:-1]:
                sound += ringing.push(None)
            return sound
        for ringing in self._ringing:
            sound += ringing.push(None)
        self._ringing = [ringing for ringing in self._ringing if ringing.silent_blocks_left > 0]
        return sound
