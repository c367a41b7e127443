"""Many folds in motion: those alike side by side, one in each lane of the step.

The numbers of a fold do not depend on its neighbours: each lane is arithmetic of its own, and a batch that is not full
is filled with copies of its first fold. So a point of a sweep is the same, bit for bit, whatever batch it is in, and a
fold that diverges disturbs no other. In single precision (twice the lanes) displacements carry seven digits.
"""

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from vfcore.errors import Cancelled, DivergenceError
from vfcore.fold import assemble
from vfcore.fold.march import diverged, flat_bump, record_every, samples_per_chunk
from vfcore.fold.statics import StaticShape
from vfcore.kernels.fold import LARGEST_DISPLACEMENT_M, step_kernel
from vfcore.kernels.layout import LANES, RECORD, SCALARS, Layout

#: The columns of layout.RECORD that folds differ in: beyond the glottis all are P_s and 0.
OF_EACH = RECORD[: RECORD.index("inlet_pressure_pa")]
FLOW = OF_EACH.index("glottal_flow_m3_s")


class Motion(NamedTuple):
    """One fold to be set in motion: from ``start``, or flat with a bump of 1 nm.

    ``left_out``: of how many of the first samples nothing is kept but the flow.
    """

    fold: assemble.Fold
    time_step_s: float
    pressure_pa: float
    duration_s: float
    rise_s: float = 0.0
    start: StaticShape | None = None
    left_out: int = 0

    @property
    def sample_s(self) -> float:
        """Time between two recorded samples."""
        return self.time_step_s * record_every(self.time_step_s)


class Marched(NamedTuple):
    """The record (samples − left_out, len(OF_EACH)) of one fold and its flow (samples,), m³/s, each column contiguous
    and in the precision of the march; ``sample_s``: time between two samples.
    """

    record: np.ndarray
    flow_m3_s: np.ndarray
    sample_s: float


def march_many(
    motions: Sequence[Motion],
    *,
    single_precision: bool = False,
    stop: Callable[[], bool] | None = None,
    progress: Callable[[float], None] | None = None,
) -> Iterator[tuple[int, Marched | DivergenceError]]:
    """March all and yield (index, outcome) as batches finish, the outcome of a fold that diverges being the error.

    A batch is marched when its first outcome is asked for.

    ``progress(fraction)`` of all steps is told, and ``stop()`` asked, between chunks of 40 ms of voice or less;
    Cancelled is raised when it answers true. The step holds no GIL: several threads may march at a time.
    """
    precision = "float32" if single_precision else "float64"
    alike: dict[tuple, list[int]] = defaultdict(list)
    for index, motion in enumerate(motions):
        fold, samples = motion.fold, round(motion.duration_s / motion.sample_s)
        alike[fold.nx, fold.ny, fold.rotation, motion.time_step_s, motion.left_out, samples].append(index)
    together = LANES[precision]
    batches = [
        (key[-1], members[begin : begin + together])
        for key, members in alike.items()
        for begin in range(0, len(members), together)
    ]
    for done, (samples, members) in enumerate(batches):
        batch = _Batch([motions[index] for index in members], precision)
        told = (lambda part, done=done: progress((done + part) / len(batches))) if progress is not None else None
        records, flows = batch.run(samples, told, stop)
        for place, index in enumerate(members):
            problem = batch.problems[place]
            yield index, problem or Marched(records[place].T, flows[place], motions[index].sample_s)


class _Batch:
    """Up to LANES[precision] folds of one grid, step and length, side by side in one buffer."""

    def __init__(self, motions: Sequence[Motion], precision: str):
        first = motions[0].fold
        self.motions, self.folds = motions, LANES[precision]
        self.time_step_s, self.left_out = motions[0].time_step_s, motions[0].left_out
        self.record_every = record_every(self.time_step_s)
        self.problems: list[DivergenceError | None] = [None] * len(motions)
        self.layout = Layout(first.nx, first.ny, self.folds, self.folds)
        self.buffer = assemble.empty_buffer(self.layout, precision)
        self._beyond = assemble.beyond(self.buffer, self.layout)[: len(motions)]
        self.scalars = np.empty((len(SCALARS), self.folds), precision)
        filled = [*motions, *[motions[0]] * (self.folds - len(motions))]
        for place, motion in enumerate(filled):
            assemble.fill(self.buffer, self.layout, place, motion.fold, self.time_step_s)
            self.scalars[:, place] = assemble.scalars(motion.fold, self.time_step_s)
            self._start(place, motion)
        self._advance = step_kernel(first.nx, first.ny, first.rotation, precision, many=True)
        self._before = self.buffer.copy()
        self._pressure_pa = np.array([motion.pressure_pa for motion in filled])
        self._steady_pa = np.empty((0, self.folds), precision)
        self._rise_s = np.array([motion.rise_s for motion in filled])

    def _start(self, place: int, motion: Motion) -> None:
        fold, shape = motion.fold, motion.start
        w = assemble.membranes(self.buffer, self.layout)[:, :, place]
        if shape is None:
            w[:] = flat_bump(fold)
            return
        w[:] = shape.w_m
        assemble.beams(self.buffer, self.layout)[:, place] = shape.w_b
        if fold.rotation:
            assemble.membranes(self.buffer, self.layout, "phi")[:-1, :, place] = np.diff(shape.w_m, axis=0) / fold.dy

    def run(
        self, samples: int, progress: Callable[[float], None] | None, stop: Callable[[], bool] | None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Records (len(motions), len(OF_EACH), samples − left_out) and flows (len(motions), samples); a fold in
        ``problems`` has none.
        """
        kind, count, skip = self.buffer.dtype, len(self.motions), self.left_out
        records, flows = np.empty((count, len(OF_EACH), samples - skip), kind), np.empty((count, samples), kind)
        per_chunk = samples_per_chunk(self.motions[0].fold, self.time_step_s)
        room = np.empty((min(per_chunk, samples), len(RECORD), self.folds), self.buffer.dtype)
        for begin in range(0, samples, per_chunk):
            if stop is not None and stop():
                raise Cancelled("the run was stopped")
            end = min(begin + per_chunk, samples)
            chunk = room[: end - begin]
            self._chunk(begin, chunk)
            flows[:, begin:end] = chunk[:, FLOW, :count].T
            if end > skip:
                kept = chunk[max(skip - begin, 0) :, : len(OF_EACH), :count]
                records[:, :, max(begin - skip, 0) : end - skip] = kept.transpose(2, 1, 0)
            if progress is not None:
                progress(end / samples)
            if None not in self.problems:
                break
        return records, flows

    def _chunk(self, first_sample: int, record: np.ndarray) -> None:
        self._before[:] = self.buffer
        first = first_sample * self.record_every
        steps = np.arange(first, first + len(record) * self.record_every)
        self._step(self.buffer, steps, self.record_every, record)
        fresh = [place for place in np.flatnonzero(self._beyond) if self.problems[place] is None]
        if fresh:
            self._locate(fresh, self._before, steps)

    def _step(self, buffer: np.ndarray, steps: np.ndarray, every: int, record: np.ndarray) -> None:
        pressures = self._pressures_at(steps)
        self._advance(buffer, self.scalars.reshape(-1), pressures.reshape(-1), every, record.reshape(-1))

    def _pressures_at(self, steps: np.ndarray) -> np.ndarray:
        """Lung pressure (steps, folds), Pa; to be read only."""
        if len(steps) > len(self._steady_pa):
            self._steady_pa = np.tile(self._pressure_pa.astype(self.buffer.dtype), (len(steps), 1))
        pressures = self._steady_pa[: len(steps)]
        rising = np.flatnonzero(self._rise_s > steps[0] * self.time_step_s)
        if rising.size:
            pressures = pressures.copy()
            pressures[:, rising] *= np.minimum(steps[:, None] * self.time_step_s / self._rise_s[rising], 1.0)
        return pressures

    def _locate(self, places: list[int], buffer: np.ndarray, steps: np.ndarray) -> None:
        """Replay a chunk step by step and note, for each of ``places``, when and where it left the bounds."""
        scratch = np.empty((1, len(RECORD), self.folds), buffer.dtype)
        for step in steps:
            self._step(buffer, np.array([step]), 1, scratch)
            beyond = ~(np.abs(assemble.membranes(buffer, self.layout)) < LARGEST_DISPLACEMENT_M)  # NaN is beyond, too
            for place in [place for place in places if beyond[:, :, place].any()]:
                fold = self.motions[place].fold
                self.problems[place] = diverged(fold, self.time_step_s, step, beyond[:, :, place])
                places.remove(place)
            if not places:
                return
