"""Time march of many glottises: those of one form, step and length share a buffer, one per vector element.

The result of a glottis does not depend on the others: vector arithmetic is elementwise, and a batch that is not full
is padded with copies of its first glottis. So a point of a sweep is the same, bit for bit, in any batch, and a glottis
that diverges does not disturb the others. Single precision (twice as many per vector) has seven digits.
"""

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from vfcore.airways.coupled import Airways
from vfcore.errors import Cancelled, DivergenceError
from vfcore.fold.assemble import Glottis
from vfcore.fold.form import LANES, RECORD, StepForm
from vfcore.fold.march import Glottises, record_every, samples_per_chunk
from vfcore.fold.statics import StaticShape

#: The columns that are stored: no measure of a point of a sweep needs the others.
OF_EACH = RECORD[: RECORD.index("inlet_pressure_pa")]
FLOW = RECORD.index("glottal_flow_m3_s")


class MarchInput(NamedTuple):
    """One glottis and how to march it: from the static shapes ``start``, or flat with a bump of 1 nm.

    ``airways``: those that act back, None with one-way coupling. ``flow_only_samples``: number of samples at the
    beginning of which only the flow is stored.
    """

    glottis: Glottis
    time_step_s: float
    pressure_pa: float
    duration_s: float
    rise_s: float = 0.0
    start: tuple[StaticShape, ...] | None = None
    flow_only_samples: int = 0
    airways: Airways | None = None

    @property
    def sample_s(self) -> float:
        """Time between two recorded samples."""
        return self.time_step_s * record_every(self.time_step_s)

    def form(self, precision: str) -> StepForm:
        """The form of the step in which it marches."""
        return self.glottis.form(coupled=self.airways is not None, many=True, precision=precision)


class MarchResult(NamedTuple):
    """The record (samples − flow_only_samples, len(OF_EACH)) of one glottis and its flow (samples,), m³/s.

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
    """March all inputs; yield (index, result or the error of a glottis that diverged) as batches finish.

    A batch is marched when its first result is requested. Between chunks of at most 40 ms of voice ``progress`` is
    called with the finished fraction, and ``stop()`` is checked; if it returns true, Cancelled is raised. The step
    releases the GIL, so several threads can march at the same time.
    """
    precision = "float32" if single_precision else "float64"
    alike: dict[tuple, list[int]] = defaultdict(list)
    for index, one in enumerate(inputs):
        samples = round(one.duration_s / one.sample_s)
        tubes = one.airways.shape if one.airways else None
        alike[one.form(precision), tubes, one.time_step_s, one.flow_only_samples, samples].append(index)
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


class _Batch(Glottises):
    """Up to LANES[precision] glottises of the same form, step and length in one buffer."""

    def __init__(self, inputs: Sequence[MarchInput], precision: str):
        self.inputs, first = inputs, inputs[0]
        form = first.form(precision)
        padded = [*inputs, *[first] * (form.lanes - len(inputs))]
        air = None
        if first.airways is not None:
            air = Airways.new_buffers([(one.airways, one.pressure_pa) for one in padded if one.airways], precision)
        super().__init__([one.glottis for one in padded], form, first.time_step_s, air)
        self.flow_only_samples = first.flow_only_samples
        self.errors: list[DivergenceError | None] = [None] * len(inputs)
        for place, one in enumerate(padded):
            self.start(place, one.start)
        self._before, self._air_before = self.buffer.copy(), self.air.copy()
        self._pressure_pa = np.array([one.pressure_pa for one in padded])
        self._steady_pa = np.empty((0, form.lanes), precision)
        self._rise_s = np.array([one.rise_s for one in padded])

    def run(
        self, samples: int, progress: Callable[[float], None] | None, stop: Callable[[], bool] | None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Records (len(inputs), columns, samples − flow_only_samples) and flows (len(inputs), samples).

        Those of a glottis with an entry in ``errors`` are meaningless.
        """
        kind, count, skip = self.buffer.dtype, len(self.inputs), self.flow_only_samples
        columns = len(OF_EACH)
        records, flows = np.empty((count, columns, samples - skip), kind), np.empty((count, samples), kind)
        per_chunk = samples_per_chunk(self.glottises[0], self.time_step_s)
        chunk_record = np.empty((min(per_chunk, samples), len(self.form.record), self.form.lanes), kind)
        for begin in range(0, samples, per_chunk):
            if stop is not None and stop():
                raise Cancelled("the run was stopped")
            end = min(begin + per_chunk, samples)
            chunk = chunk_record[: end - begin]
            self._chunk(begin, chunk)
            flows[:, begin:end] = chunk[:, FLOW, :count].T
            if end > skip:
                kept = chunk[max(skip - begin, 0) :, :columns, :count]
                records[:, :, max(begin - skip, 0) : end - skip] = kept.transpose(2, 1, 0)
            if progress is not None:
                progress(end / samples)
            if None not in self.errors:
                break
        return records, flows

    def _chunk(self, first_sample: int, record: np.ndarray) -> None:
        self._before[:], self._air_before[:] = self.buffer, self.air
        first = first_sample * self.record_every
        steps = np.arange(first, first + len(record) * self.record_every)
        pressures = self._pressures_at(steps)
        self.advance(pressures, self.record_every, record)
        seen = self.beyond[: len(self.inputs)]
        new = [place for place in np.flatnonzero(seen).tolist() if self.errors[place] is None]
        if new:
            for place, error in self.diverging(new, self._before, self._air_before, steps, pressures):
                self.errors[place] = error

    def _pressures_at(self, steps: np.ndarray) -> np.ndarray:
        """Lung pressure (steps, glottises), Pa; do not write to it."""
        if len(steps) > len(self._steady_pa):
            self._steady_pa = np.tile(self._pressure_pa.astype(self.buffer.dtype), (len(steps), 1))
        pressures = self._steady_pa[: len(steps)]
        rising = np.flatnonzero(self._rise_s > steps[0] * self.time_step_s)
        if rising.size:
            pressures = pressures.copy()
            pressures[:, rising] *= np.minimum(steps[:, None] * self.time_step_s / self._rise_s[rising], 1.0)
        return pressures
