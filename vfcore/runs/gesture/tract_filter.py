"""The tract, block by block: a running convolution that changes its vowel without a seam.

A new vowel does not replace the filter: over one block the glottal flow is faded out of the old tract and into the new
one, and the old one rings to its end. Both are linear, so nothing clicks.
"""

import numpy as np

from vfcore.airways.impulse_response import response_at
from vfcore.airways.tract import Tract
from vfcore.kernels.response import respond

#: Energy of the response that is left out: 80 dB below the voice.
LEFT_OUT_ENERGY = 1e-8


class Filter:
    """One tract's responses: lip pressure and, where it is wanted, pressure at 0.3 m.

    ``backward`` and ``memory`` are those of kernels/response.py, for each of them.
    """

    def __init__(self, tract: Tract, time_step_s: float, block: int, far: bool):
        lip, _, away = response_at(tract, time_step_s)
        energy = np.cumsum(lip * lip)
        taps = int(np.searchsorted(energy, (1.0 - LEFT_OUT_ENERGY) * energy[-1])) + 1
        self.tract, self._block = tract, block
        self.backward = [np.ascontiguousarray(row[:taps][::-1]) for row in ((lip, away) if far else (lip,))]
        self.memory = [np.zeros(taps - 1 + block) for _ in self.backward]
        self._silence = np.zeros(block)
        self.silent_blocks_left = -(-taps // block)

    def push(self, flow: np.ndarray | None) -> np.ndarray:
        """The next block of sound (rows, block), Pa; without flow the tract rings on."""
        if flow is None:
            self.silent_blocks_left -= 1
            flow = self._silence
        out = np.empty((len(self.backward), self._block))
        for backward, memory, row in zip(self.backward, self.memory, out, strict=True):
            respond(flow, memory, backward, row)
        return out

    def far(self, flow: np.ndarray) -> np.ndarray | None:
        """The next block (block,) of pressure at 0.3 m alone, Pa; None where it is not wanted."""
        if len(self.backward) < 2:
            return None
        out = np.empty(self._block)
        respond(flow, self.memory[1], self.backward[1], out)
        return out


class Lips:
    """Sound of a glottal flow that comes in blocks of ``block`` samples; with ``far`` also the sound at 0.3 m."""

    def __init__(self, tract: Tract, time_step_s: float, block: int, far: bool = True):
        self._time_step_s, self._block, self._far = time_step_s, block, far
        self._now = self._filter(tract)
        self._ringing: list[Filter] = []
        self._fade_in = (np.arange(block) + 0.5) / block

    def _filter(self, tract: Tract) -> Filter:
        return Filter(tract, self._time_step_s, self._block, self._far)

    def steady(self, tract: Tract) -> Filter | None:
        """The filter of ``tract`` while it is the only one that sounds."""
        now = self._now
        return now if not self._ringing and (tract is now.tract or tract == now.tract) else None

    def push(self, flow_m3_s: np.ndarray, tract: Tract) -> np.ndarray:
        """Pressure at the lips and, with ``far``, at 0.3 m, Pa, (1 or 2, block), for one block of flow."""
        if tract is self._now.tract or tract == self._now.tract:
            sound = self._now.push(flow_m3_s)
        else:
            old, self._now = self._now, self._filter(tract)
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
