"""A voice whose parameters move: posture, fold, tract and audio, advanced in blocks of 10 ms.

Live playing and offline rendering use the same engine, so the same targets give the same samples.
"""

from typing import NamedTuple

import numpy as np

from vfcore.airways.coupled import airways_of, tract_of
from vfcore.errors import ParameterError
from vfcore.fold.assemble import Fold
from vfcore.fold.march import TimeMarch
from vfcore.kernels.layout import RECORD
from vfcore.runs.gesture.glide import FoldSpec, GlidingFold, check_step
from vfcore.runs.gesture.resample import Resampler
from vfcore.runs.gesture.tract_filter import TractFilter
from vfcore.runs.one import posture_of, prepare
from vfcore.spec.simulation import DEFAULT_STEP_S, Simulation

BLOCK_STEPS = 280  # 10 ms at the default step: a whole number of audio samples (480)
BLOCK_S = BLOCK_STEPS * DEFAULT_STEP_S


class Block(NamedTuple):
    """10 ms of voice: ``record`` (280, 7) of layout.RECORD; pressure at the lips and at 0.3 m (280,), Pa, the latter
    None for a played voice; pressure at the lips at 48 kHz (480,), Pa, delayed by ``Voice.audio_delay_s``.
    """

    record: np.ndarray
    lip_pressure_pa: np.ndarray
    far_pressure_pa: np.ndarray | None
    audio_pa: np.ndarray


class Voice:
    """One voice from its onset on. ``advance(target)`` moves to ``target`` within a block.

    The grid, the shear form and the step are those of ``start``; targets that differ in them are refused. ``played``:
    the sound at 0.3 m is left out, and each block reuses the memory of the one before, to keep the cache warm. Raises
    ParameterError, PostureError or DivergenceError.
    """

    def __init__(self, start: Simulation, played: bool = False):
        ready = prepare(start)
        if start.run.time_step_s is not None:
            raise ParameterError("run.time_step_s", "is fixed while parameters move", "null")
        airways = airways_of(start, DEFAULT_STEP_S)  # those of the first vowel: their load on the folds does not glide
        march = TimeMarch(ready.fold, DEFAULT_STEP_S, start.subglottal_pressure_pa, airways=airways)
        march.start_static(ready.static) if start.run.start == "static" else march.start_flat()
        self.request, self.posture = start, ready.posture
        check_step(ready.fold, DEFAULT_STEP_S)
        self._gliding = GlidingFold(march, FoldSpec(start, ready.posture))
        self._now_tract = tract_of(start)
        self._tract_filter = TractFilter(self._now_tract, DEFAULT_STEP_S, BLOCK_STEPS, far=not played)
        self._resampler = Resampler(1.0 / DEFAULT_STEP_S, BLOCK_STEPS)
        self._played = played
        self._buffers = self._new_buffers()
        self.blocks = 0

    @property
    def audio_delay_s(self) -> float:
        """The delay of the audio against the record."""
        return self._resampler.delay_s

    @property
    def fold(self) -> Fold:
        return self._gliding.fold

    @property
    def seen(self) -> tuple[np.ndarray, np.ndarray]:
        """Displacement of the membrane (ny, nx) and the beam (nx,) at the last ``look_at``, m."""
        return self._gliding.seen

    @property
    def outline(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Outline of the folds: x (nx,), the membrane's displacement at the last ``look_at`` and the medial plane, both
        (ny, nx), m.
        """
        medial_m = self._gliding.medial_m
        return np.linspace(0.0, self.posture.length_m, medial_m.shape[1]), self._gliding.seen[0], medial_m

    def advance(self, target: Simulation, look_at: int = 0) -> Block:
        """The next block, at whose end the request is ``target``. ``look_at``: the step at which ``seen`` is taken."""
        spec = self._spec_of(target)
        tract = self._now_tract if _same_tract(target, self.request) else tract_of(target)
        record, lip, audio = self._buffers if self._played else self._new_buffers()
        self._gliding.advance(spec, target.subglottal_pressure_pa, BLOCK_STEPS, look_at, record)
        flow = record[:, 1]
        steady = self._tract_filter.steady(tract)
        if steady is not None:
            self._resampler.push_through(flow, steady, lip, audio)
            far = steady.far(flow)
        else:
            lip, *others = self._tract_filter.push(flow, tract)
            far = others[0] if others else None
            audio = self._resampler.push(lip)
        self.request, self.posture, self._now_tract = target, spec.posture, tract
        self.blocks += 1
        return Block(record, lip, far, audio)

    def _new_buffers(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Arrays for record, pressure at the lips and audio of a block."""
        return np.empty((BLOCK_STEPS, len(RECORD))), np.empty(BLOCK_STEPS), self._resampler.empty()

    def _spec_of(self, target: Simulation) -> FoldSpec:
        now = self.request
        if target is now or _same_fold(target, now):
            return self._gliding.spec
        if (part := fixed_part_changed(now, target)) is not None:
            raise ParameterError(part, "cannot change once the voice has begun", "a new voice")
        same_posture = (target.activation, target.posture, target.posturing, target.constants.L_0_m) == (
            now.activation,
            now.posture,
            now.posturing,
            now.constants.L_0_m,
        )
        return FoldSpec(target, self.posture if same_posture else posture_of(target))


def fixed_part_changed(one: Simulation, other: Simulation) -> str | None:
    """The part in which two requests differ although it is fixed during a voice; None where there is none."""
    return next((part for part in ("run", "model") if getattr(one, part) != getattr(other, part)), None)


def _same_tract(a: Simulation, b: Simulation) -> bool:
    """Whether both are known to have the same tract."""
    return a is b or (a.vowel == b.vowel and a.larynx is b.larynx)


def _same_fold(a: Simulation, b: Simulation) -> bool:
    """Whether the requests differ at most in breath or vowel."""
    return (a.activation, a.posture, a.posturing, a.constants, a.convergence_angle_rad, a.run, a.model) == (
        b.activation, b.posture, b.posturing, b.constants, b.convergence_angle_rad, b.run, b.model
    )  # fmt: skip
