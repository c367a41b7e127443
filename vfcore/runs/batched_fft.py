"""Runs in single precision measured side by side: their transforms share the lanes that one alone would leave idle."""

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from vfcore.airways.sound import measured_sounds
from vfcore.airways.tract import Tract
from vfcore.fold.march_many import OF_EACH, MarchResult
from vfcore.measures.pitch import Autocorrelation, autocorrelations
from vfcore.measures.signals import Sound, window_start

AREA = OF_EACH.index("glottal_area_m2")
#: Waves transformed at a time: so many single numbers are worked on together by what transforms them.
TOGETHER = 4


class Together:
    """Up to TOGETHER runs of one tract, step and length; what they share is worked out when the first asks for it.

    What a run gets does not depend, bit for bit, on the others: fewer than TOGETHER are filled up with copies of the
    first.
    """

    def __init__(self, outcomes: Sequence[MarchResult], tract: Tract):
        self._outcomes, self._tract = outcomes, tract
        first = outcomes[0]
        self._left_out = len(first.flow_m3_s) - len(first.record)
        self._start = window_start(len(first.flow_m3_s)) - self._left_out

    @cached_property
    def sounds(self) -> list[Sound]:
        """Sound of each run where it is measured, as ``measured_sound`` has it."""
        return measured_sounds(
            self._tract, _filled([run.flow_m3_s for run in self._outcomes]), self._outcomes[0].sample_s, self._left_out
        )

    @cached_property
    def correlations(self) -> list[Autocorrelation]:
        """Autocorrelation of each run's area where it is measured."""
        return autocorrelations(_filled([run.record[self._start :, AREA] for run in self._outcomes]))


def _filled(waves: Sequence[np.ndarray]) -> np.ndarray:
    return np.stack([*waves, *[waves[0]] * (TOGETHER - len(waves))])
