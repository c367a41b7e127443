"""Fourier transforms of several runs in one call: in single precision a SIMD register holds a sample of each."""

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from vfcore.airways.sound import measured_sounds
from vfcore.airways.tract import Tract
from vfcore.fold.march_many import OF_EACH, MarchResult
from vfcore.measures.pitch import Autocorrelation, autocorrelations
from vfcore.measures.signals import Sound, window_start

AREA = OF_EACH.index("glottal_area_m2")
#: Waves transformed in one call: the single-precision numbers of one SIMD register.
BATCH = 4


class BatchedFFT:
    """Sound and autocorrelation of up to BATCH runs of one tract, step and length, computed at the first access.

    What a run gets does not depend, bit for bit, on the others: fewer than BATCH are filled up with copies of the
    first.
    """

    def __init__(self, runs: Sequence[MarchResult], tract: Tract):
        self._runs, self._tract = runs, tract
        first = runs[0]
        self._left_out = len(first.flow_m3_s) - len(first.record)
        self._start = window_start(len(first.flow_m3_s)) - self._left_out

    @cached_property
    def sounds(self) -> list[Sound]:
        """Sound of each run in its measured part, as of ``measured_sound``."""
        return measured_sounds(
            self._tract, _filled([run.flow_m3_s for run in self._runs]), self._runs[0].sample_s, self._left_out
        )

    @cached_property
    def correlations(self) -> list[Autocorrelation]:
        """Autocorrelation of each run's area in its measured part."""
        return autocorrelations(_filled([run.record[self._start :, AREA] for run in self._runs]))


def _filled(waves: Sequence[np.ndarray]) -> np.ndarray:
    return np.stack([*waves, *[waves[0]] * (BATCH - len(waves))])
