"""A voice whose parameters move: posture, fold, tract and audio, advanced in blocks of 10 ms.

Live playing and offline rendering use the same engine, so the same targets give the same samples.
"""

from dataclasses import fields, replace
from typing import NamedTuple

import numpy as np

from vfcore.airways.coupled import airways_of, tract_of
from vfcore.errors import ParameterError
from vfcore.fold.assemble import Glottis
from vfcore.fold.form import RECORD, StepForm
from vfcore.fold.march import TimeMarch
from vfcore.fold.statics import static_shapes_of
from vfcore.larynx.posture.solution import PostureSolution
from vfcore.runs.gesture.glide import GlidingGlottis, GlottisSpec, check_step
from vfcore.runs.gesture.resample import Resampler
from vfcore.runs.gesture.tract_filter import TractFilter
from vfcore.runs.setup import glottis_of, mean_posture, postures_of
from vfcore.spec.sides import folds_of
from vfcore.spec.simulation import DEFAULT_STEP_S, Simulation

BLOCK_STEPS = 280  # 10 ms at the default step: a whole number of audio samples (480)
BLOCK_S = BLOCK_STEPS * DEFAULT_STEP_S


class Block(NamedTuple):
    """10 ms of voice: ``record`` (280, 7) of vfcore.fold.form.RECORD; pressure at the lips and at 0.3 m (280,), Pa, the
    latter None for a played voice; pressure at the lips at 48 kHz (480,), Pa, delayed by ``Voice.audio_delay_s``.
    """

    record: np.ndarray
    lip_pressure_pa: np.ndarray
    far_pressure_pa: np.ndarray | None
    audio_pa: np.ndarray


class Voice:
    """One voice from its onset on. ``advance(target)`` moves to ``target`` within a block.

    The grid, the model and the step are those of ``start``; targets that differ in them are refused. The folds are one
    and its mirror image until they differ, from then on two walls. ``played``: the sound at 0.3 m is left out, and each
    block reuses the memory of the one before, to keep the cache warm. Raises ParameterError, PostureError or
    DivergenceError.
    """

    def __init__(self, start: Simulation, played: bool = False):
        if start.run.time_step_s is not None:
            raise ParameterError("run.time_step_s", "is fixed while parameters move", "null")
        airways = airways_of(start, DEFAULT_STEP_S)  # those of the first vowel: their load on the folds does not glide
        folds = folds_of(start)
        postures = postures_of(folds)
        glottis = glottis_of(folds, postures)
        check_step(glottis, DEFAULT_STEP_S)
        march = TimeMarch(glottis, DEFAULT_STEP_S, start.subglottal_pressure_pa, airways=airways)
        march.start(0, static_shapes_of(glottis) if start.run.start == "static" else None)
        self.request = start
        self._gliding = GlidingGlottis(march, GlottisSpec(folds, postures))
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
    def form(self) -> StepForm:
        """The present form of the step."""
        return self._gliding.form

    @property
    def glottis(self) -> Glottis:
        return self._gliding.glottis

    @property
    def postures(self) -> tuple[PostureSolution, ...]:
        """The posture of each fold of the request."""
        return self._gliding.spec.postures

    @property
    def posture(self) -> PostureSolution:
        """The posture; of two different folds the mean of both."""
        return mean_posture(self.postures)

    @property
    def seen(self) -> tuple[np.ndarray, np.ndarray]:
        """Displacement of the membranes (walls, ny, nx) and the beams (walls, nx) at the last ``look_at``, m."""
        return self._gliding.seen

    @property
    def outline(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Outline of the folds: x (walls, nx), the membranes' displacement at the last ``look_at`` and the medial
        planes, both (walls, ny, nx), m.
        """
        x_m = np.array([wall.x_m for wall in self.glottis.walls])
        return x_m, self._gliding.seen[0], self._gliding.medial_m

    def form_for(self, target: Simulation) -> StepForm:
        """The form of the step in which this voice can reach ``target``: its present one where that is enough."""
        two = target.left is not None or target.right is not None or len(folds_of(target)) == 2
        needed = replace(self.form, walls=2 if two else 1, patched=bool(target.lesions))
        return self.form.covering(needed)

    def advance(self, target: Simulation, look_at: int = 0) -> Block:
        """The next block, at whose end the request is ``target``. ``look_at``: the step at which ``seen`` is taken."""
        spec = self._spec_of(target)
        tract = self._now_tract if _same_tract(target, self.request) else tract_of(target)
        record, lip, audio = self._buffers if self._played else self._new_buffers()
        record = self._gliding.advance(spec, target.subglottal_pressure_pa, BLOCK_STEPS, look_at, record)[
            :, : len(RECORD)
        ]
        flow = record[:, 1]
        steady = self._tract_filter.steady(tract)
        if steady is not None:
            self._resampler.push_through(flow, steady, lip, audio)
            far = steady.far(flow)
        else:
            lip, *others = self._tract_filter.push(flow, tract)
            far = others[0] if others else None
            audio = self._resampler.push(lip)
        self.request, self._now_tract = target, tract
        self.blocks += 1
        return Block(record, lip, far, audio)

    def _new_buffers(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Arrays for record, pressure at the lips and audio of a block."""
        record = np.empty((BLOCK_STEPS, len(self.form.record)))
        return record, np.empty(BLOCK_STEPS), self._resampler.empty()

    def _spec_of(self, target: Simulation) -> GlottisSpec:
        now, spec = self.request, self._gliding.spec
        if target is now or _same_folds(target, now):
            return spec
        if (part := fixed_part_changed(now, target)) is not None:
            raise ParameterError(part, "cannot change once the voice has begun", "a new voice")
        folds = folds_of(target)
        if len(folds) == len(spec.folds) and all(map(_same_posture, folds, spec.folds)):
            return GlottisSpec(folds, spec.postures)
        return GlottisSpec(folds, postures_of(folds))


def fixed_part_changed(one: Simulation, other: Simulation) -> str | None:
    """The part in which two requests differ although it is fixed during a voice; None where there is none."""
    return next((part for part in ("run", "model") if getattr(one, part) != getattr(other, part)), None)


def _same_tract(a: Simulation, b: Simulation) -> bool:
    """Whether both are known to have the same tract."""
    return a is b or (a.vowel == b.vowel and a.larynx is b.larynx)


def _same_folds(a: Simulation, b: Simulation) -> bool:
    """Whether the requests differ at most in breath or vowel."""
    return all(getattr(a, name) == getattr(b, name) for name in _OF_FOLDS)


#: The parts of a request that the folds depend on.
_OF_FOLDS = tuple(spec.name for spec in fields(Simulation) if spec.name not in ("subglottal_pressure_pa", "vowel"))


def _same_posture(a: Simulation, b: Simulation) -> bool:
    """Whether two folds have the same posture for sure."""
    return (a.activation, a.posture, a.posturing, a.constants.L_0_m) == (
        b.activation, b.posture, b.posturing, b.constants.L_0_m
    )  # fmt: skip
