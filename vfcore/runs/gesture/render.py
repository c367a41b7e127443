"""Rendering of a gesture: waveforms, contours of parameters and sound, measures per segment."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from vfcore.errors import Cancelled
from vfcore.fold.assemble import Glottis
from vfcore.fold.form import StepForm
from vfcore.larynx.posture.solution import PostureSolution
from vfcore.measures.catalogue import MeasureReport, measure_all
from vfcore.measures.signals import MIN_SAMPLES, Sound
from vfcore.runs.gesture.contours import contour, level_db, pitch_hz
from vfcore.runs.gesture.gesture import Gesture
from vfcore.runs.gesture.voice import BLOCK_S, Block, Voice
from vfcore.runs.one import signals_of, waveforms
from vfcore.runs.setup import mean_posture
from vfcore.spec.simulation import DEFAULT_STEP_S, Simulation

RATE_HZ = 1.0 / DEFAULT_STEP_S


class State(NamedTuple):
    """Postures and glottis at the end of a block."""

    postures: tuple[PostureSolution, ...]
    glottis: Glottis


@dataclass(frozen=True, slots=True, eq=False)
class Segment:
    """A segment between two breakpoints; ``report`` measures its last half with the posture at its end."""

    start_s: float
    end_s: float
    report: MeasureReport


@dataclass(frozen=True, slots=True, eq=False)
class RenderedGesture:
    """``waves``: (n,) each, at 28 kHz, named as in a simulation's arrays. ``contours``: (blocks,) each, one value per
    10 ms: time_s, fo_hz, spl_lips_db, spl_30cm_db, strain, glottal_half_angle_rad, length_m, and each moving number by
    its path. ``audio_pa``: at 48 kHz, Pa, delayed by ``audio_delay_s``.
    """

    gesture: Gesture
    waves: dict[str, np.ndarray]
    contours: dict[str, np.ndarray]
    segments: tuple[Segment, ...]
    audio_pa: np.ndarray
    audio_delay_s: float


def render(
    gesture: Gesture,
    progress: Callable[[float], None] | None = None,
    stop: Callable[[], bool] | None = None,
) -> RenderedGesture:
    """Run a gesture over its ``run.duration_s``.

    ``progress(fraction)`` is called after each block of 10 ms, ``stop()`` before each. Raises ParameterError,
    PostureError, DivergenceError, Cancelled.
    """
    count = math.ceil(gesture.start.run.duration_s / BLOCK_S - 1e-9)
    voice = Voice(gesture.at(0.0))
    return collect(gesture, voice, (gesture.at((k + 1) * BLOCK_S) for k in range(count)), count, progress, stop)


def collect(
    gesture: Gesture,
    voice: Voice,
    targets: Iterator[Simulation],
    count: int,
    progress: Callable[[float], None] | None = None,
    stop: Callable[[], bool] | None = None,
) -> RenderedGesture:
    """Advance a voice through ``count`` targets and collect the result."""
    blocks: list[Block] = []
    states: list[State] = []
    for target in targets:
        if stop is not None and stop():
            raise Cancelled("the run was stopped")
        blocks.append(voice.advance(target))
        states.append(State(voice.postures, voice.glottis))
        if progress is not None:
            progress(len(blocks) / count)
    waves = _waves(blocks, voice.form)
    return RenderedGesture(
        gesture,
        waves,
        _contours(gesture, waves, states),
        tuple(_segments(gesture, waves, states)),
        np.concatenate([block.audio_pa for block in blocks]),
        voice.audio_delay_s,
    )


def _waves(blocks: list[Block], form: StepForm) -> dict[str, np.ndarray]:
    return waveforms(np.concatenate([block.record for block in blocks]), DEFAULT_STEP_S, form) | {
        "radiated_pressure_pa": np.concatenate([block.lip_pressure_pa for block in blocks]),
        "far_pressure_pa": np.concatenate([block.far_pressure_pa for block in blocks]),
    }


def _contours(gesture: Gesture, waves: dict[str, np.ndarray], states: list[State]) -> dict[str, np.ndarray]:
    times = (np.arange(len(states)) + 1) * BLOCK_S
    contours = {
        "time_s": times,
        "fo_hz": contour(partial(pitch_hz, sample_rate_hz=RATE_HZ), waves["glottal_area_m2"], RATE_HZ, times),
        "spl_lips_db": contour(level_db, waves["radiated_pressure_pa"], RATE_HZ, times),
        "spl_30cm_db": contour(level_db, waves["far_pressure_pa"], RATE_HZ, times),
    }
    for name in ("strain", "glottal_half_angle_rad", "length_m"):
        contours[name] = np.array([getattr(mean_posture(state.postures), name) for state in states])
    return contours | {track.path: np.array([track.at(t) for t in times]) for track in gesture.tracks}


def _segments(gesture: Gesture, waves: dict[str, np.ndarray], states: list[State]) -> Iterator[Segment]:
    for start_s, end_s in pairwise(gesture.corners_s()):
        part = slice(round(start_s * RATE_HZ), round(end_s * RATE_HZ))
        if part.stop - part.start < MIN_SAMPLES:
            continue
        state = states[min(len(states), max(1, round(end_s / BLOCK_S))) - 1]
        cut = {name: wave[part] for name, wave in waves.items()}
        signals = signals_of(gesture.at(end_s), state.postures, state.glottis, cut, DEFAULT_STEP_S)
        sound = Sound(cut["radiated_pressure_pa"], cut["far_pressure_pa"])
        yield Segment(start_s, end_s, measure_all(signals, radiate=partial(_known, sound)))


def _known(sound: Sound) -> Sound:
    return sound
