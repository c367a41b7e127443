"""The vocal tract as a block convolution that can change its vowel without a click.

A new vowel gets its own filter. Over one block the glottal flow is cross-faded from the old filter to the new one, and
the old one rings out. Both are linear, so there is no click.
"""

import numpy as np

from vfcore.airways.impulse_response import response_at
from vfcore.airways.tract import Tract
from vfcore.kernels.response import respond

#: Share of the response's energy that is truncated: 80 dB below the voice.
LEFT_OUT_ENERGY = 1e-8


class TractResponse:
    """The responses of one tract: pressure at the lips and, with ``far``, at 0.3 m.

    ``backward`` and ``memory``: for each response, the arguments of kernels/response.py.
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
        """The next block of sound (1 or 2, block), Pa; with None the tract rings on without flow."""
        if flow is None:
            self.silent_blocks_left -= 1
            flow = self._silence
        out = np.empty((len(self.backward), self._block))
        for backward, memory, row in zip(self.backward, self.memory, out, strict=True):
            respond(flow, memory, backward, row)
        return out

    def far(self, flow: np.ndarray) -> np.ndarray | None:
        """The next block of pressure at 0.3 m, (block,), Pa; None without ``far``."""
        if len(self.backward) < 2:
            return None
        out = np.empty(self._block)
        respond(flow, self.memory[1], self.backward[1], out)
        return out


class TractFilter:
    """Sound of a glottal flow that comes in blocks of ``block`` samples; with ``far`` also the sound at 0.3 m."""

    def __init__(self, tract: Tract, time_step_s: float, block: int, far: bool = True):
        self._time_step_s, self._block, self._far = time_step_s, block, far
        self._now = self._response(tract)
        self._ringing: list[TractResponse] = []
        self._fade_in = (np.arange(block) + 0.5) / block

    def _response(self, tract: Tract) -> TractResponse:
        return TractResponse(tract, self._time_step_s, self._block, self._far)

    def steady(self, tract: Tract) -> TractResponse | None:
        """The filter of ``tract`` if no other one is ringing, else None."""
        now = self._now
        return now if not self._ringing and (tract is now.tract or tract == now.tract) else None

    def push(self, flow_m3_s: np.ndarray, tract: Tract) -> np.ndarray:
        """Pressure at the lips and, with ``far``, at 0.3 m, Pa, (1 or 2, block), for one block of flow."""
        if tract is self._now.tract or tract == self._now.tract:
            sound = self._now.push(flow_m3_s)
        else:
            old, self._now = self._now, self._response(tract)
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
