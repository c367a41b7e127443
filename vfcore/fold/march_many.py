"""Time march of many folds: those with the same grid, step and length share a buffer, one fold per vector element.

The result of a fold does not depend on the others: vector arithmetic is elementwise, and a batch that is not full is
padded with copies of its first fold. So a point of a sweep is the same, bit for bit, in any batch, and a fold that
diverges does not disturb the others. Single precision (twice as many folds per vector) has seven digits.
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

#: The columns of layout.RECORD that are stored: without airways the other two are P_s and 0.
OF_EACH = RECORD[: RECORD.index("inlet_pressure_pa")]
FLOW = OF_EACH.index("glottal_flow_m3_s")


class MarchInput(NamedTuple):
    """One fold and how to march it: from ``start``, or flat with a bump of 1 nm.

    ``flow_only_samples``: number of samples at the beginning of which only the flow is stored.
    """

    fold: assemble.Fold
    time_step_s: float
    pressure_pa: float
    duration_s: float
    rise_s: float = 0.0
    start: StaticShape | None = None
    flow_only_samples: int = 0

    @property
    def sample_s(self) -> float:
        """Time between two recorded samples."""
        return self.time_step_s * record_every(self.time_step_s)


class MarchResult(NamedTuple):
    """The record (samples − flow_only_samples, len(OF_EACH)) of one fold and its flow (samples,), m³/s.

    Each column is contiguous and has the precision of the march. ``sample_s``: time between two samples.
    """

    record: np.ndarray
    flow_m3_s: np.ndarray
    sample_s: float


def march_many(
    inputs: Sequence[MarchInput],
    *,
    single_precision: bool = False,
    stop: Callable[[], bool] | None = None,
    progress: Callable[[float], None] | None = None,
) -> Iterator[tuple[int, MarchResult | DivergenceError]]:
    """March all inputs; yield (index, result or the error of a fold that diverged) as batches finish.

    A batch is marched when its first result is requested. Between chunks of at most 40 ms of voice ``progress`` is
    called with the finished fraction, and ``stop()`` is checked; if it returns true, Cancelled is raised. The step
    releases the GIL, so several threads can march at the same time.
    """
    precision = "float32" if single_precision else "float64"
    alike: dict[tuple, list[int]] = defaultdict(list)
    for index, one in enumerate(inputs):
        fold, samples = one.fold, round(one.duration_s / one.sample_s)
        alike[fold.nx, fold.ny, fold.rotation, one.time_step_s, one.flow_only_samples, samples].append(index)
    size = LANES[precision]
    batches = [
        (key[-1], members[begin : begin + size])
        for key, members in alike.items()
        for begin in range(0, len(members), size)
    ]
    for done, (samples, members) in enumerate(batches):
        batch = _Batch([inputs[index] for index in members], precision)
        report = (lambda part, done=done: progress((done + part) / len(batches))) if progress is not None else None
        records, flows = batch.run(samples, report, stop)
        for place, index in enumerate(members):
            error = batch.errors[place]
            yield index, error or MarchResult(records[place].T, flows[place], inputs[index].sample_s)


class _Batch:
    """Up to LANES[precision] folds of the same grid, step and length in one buffer."""

    def __init__(self, inputs: Sequence[MarchInput], precision: str):
        first = inputs[0].fold
        self.inputs, self.folds = inputs, LANES[precision]
        self.time_step_s, self.flow_only_samples = inputs[0].time_step_s, inputs[0].flow_only_samples
        self.record_every = record_every(self.time_step_s)
        self.errors: list[DivergenceError | None] = [None] * len(inputs)
        self.layout = Layout(first.nx, first.ny, self.folds, self.folds)
        self.buffer = assemble.empty_buffer(self.layout, precision)
        self._beyond = assemble.beyond(self.buffer, self.layout)[: len(inputs)]
        self.scalars = np.empty((len(SCALARS), self.folds), precision)
        padded = [*inputs, *[inputs[0]] * (self.folds - len(inputs))]
        for place, one in enumerate(padded):
            assemble.fill(self.buffer, self.layout, place, one.fold, self.time_step_s)
            self.scalars[:, place] = assemble.scalars(one.fold, self.time_step_s)
            self._start(place, one)
        self._advance = step_kernel(first.nx, first.ny, first.rotation, precision, many=True)
        self._before = self.buffer.copy()
        self._pressure_pa = np.array([one.pressure_pa for one in padded])
        self._steady_pa = np.empty((0, self.folds), precision)
        self._rise_s = np.array([one.rise_s for one in padded])

    def _start(self, place: int, one: MarchInput) -> None:
        fold, shape = one.fold, one.start
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
        """Records (len(inputs), len(OF_EACH), samples − flow_only_samples) and flows (len(inputs), samples).

        Those of a fold with an entry in ``errors`` are meaningless.
        """
        kind, count, skip = self.buffer.dtype, len(self.inputs), self.flow_only_samples
        records, flows = np.empty((count, len(OF_EACH), samples - skip), kind), np.empty((count, samples), kind)
        per_chunk = samples_per_chunk(self.inputs[0].fold, self.time_step_s)
        chunk_record = np.empty((min(per_chunk, samples), len(RECORD), self.folds), self.buffer.dtype)
        for begin in range(0, samples, per_chunk):
            if stop is not None and stop():
                raise Cancelled("the run was stopped")
            end = min(begin + per_chunk, samples)
            chunk = chunk_record[: end - begin]
            self._chunk(begin, chunk)
            flows[:, begin:end] = chunk[:, FLOW, :count].T
            if end > skip:
                kept = chunk[max(skip - begin, 0) :, : len(OF_EACH), :count]
                records[:, :, max(begin - skip, 0) : end - skip] = kept.transpose(2, 1, 0)
            if progress is not None:
                progress(end / samples)
            if None not in self.errors:
                break
        return records, flows

    def _chunk(self, first_sample: int, record: np.ndarray) -> None:
        self._before[:] = self.buffer
        first = first_sample * self.record_every
        steps = np.arange(first, first + len(record) * self.record_every)
        self._step(self.buffer, steps, self.record_every, record)
        diverging = [place for place in np.flatnonzero(self._beyond).tolist() if self.errors[place] is None]
        if diverging:
            self._locate(diverging, self._before, steps)

    def _step(self, buffer: np.ndarray, steps: np.ndarray, every: int, record: np.ndarray) -> None:
        pressures = self._pressures_at(steps)
        self._advance(buffer, self.scalars.reshape(-1), pressures.reshape(-1), every, record.reshape(-1))

    def _pressures_at(self, steps: np.ndarray) -> np.ndarray:
        """Lung pressure (steps, folds), Pa; do not write to it."""
        if len(steps) > len(self._steady_pa):
            self._steady_pa = np.tile(self._pressure_pa.astype(self.buffer.dtype), (len(steps), 1))
        pressures = self._steady_pa[: len(steps)]
        rising = np.flatnonzero(self._rise_s > steps[0] * self.time_step_s)
        if rising.size:
            pressures = pressures.copy()
            pressures[:, rising] *= np.minimum(steps[:, None] * self.time_step_s / self._rise_s[rising], 1.0)
        return pressures

    def _locate(self, places: list[int], buffer: np.ndarray, steps: np.ndarray) -> None:
        """Repeat a chunk step by step; store for each of ``places`` when and where it passed the bound."""
        scratch = np.empty((1, len(RECORD), self.folds), buffer.dtype)
        for step in steps:
            self._step(buffer, np.array([step]), 1, scratch)
            beyond = ~(np.abs(assemble.membranes(buffer, self.layout)) < LARGEST_DISPLACEMENT_M)  # true for NaN
            for place in [place for place in places if beyond[:, :, place].any()]:
                fold = self.inputs[place].fold
                self.errors[place] = diverged(fold, self.time_step_s, step, beyond[:, :, place])
                places.remove(place)
            if not places:
                return
