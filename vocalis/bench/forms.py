"""The forms of the step against one another: finite stretch over linear, two different walls over one fold.

All are marched in turns over the same voice, from a vibrating state, and timed in CPU time of the thread, so that other
programs count only by the caches they take. The speed of one and the same loop varies by several percent with the
address of its buffer, because the processor predicts the way of its L1 cache from address bits. So every form has
BUFFERS buffers, which it uses one after the other.
"""

import time
from collections.abc import Callable
from itertools import cycle
from typing import NamedTuple

from vfcore.fold.assemble import Glottis
from vfcore.fold.form import LANES
from vfcore.fold.march import TimeMarch
from vfcore.fold.march_many import MarchInput, march_many
from vfcore.runs.setup import prepare
from vfcore.spec.simulation import DEFAULT_STEP_S, Model, Run, Simulation
from vocalis.bench.rounds import turns

BUFFERS = 12
TURN_S = 0.01
LAPS = 4  # rounds over all buffers
SETTLE_S = 0.1  # the onset, not timed
PART_S = 0.02  # of voice in a call
BATCH_VOICE_S = 0.2
#: What differs between the walls: enough to make them two.
LEFT = {"activation.ta": 0.45}


class Form(NamedTuple):
    """A form of the step. ``precision``: that of a batch, None for one glottis alone."""

    finite: bool = False
    two: bool = False
    precision: str | None = None

    @property
    def options(self) -> tuple[str, ...]:
        """The form as ``count_step`` takes it."""
        wanted = {"finite": self.finite, "two": self.two, "many": self.precision is not None}
        return tuple(name for name, is_so in wanted.items() if is_so)

    @property
    def glottises(self) -> int:
        return 1 if self.precision is None else LANES[self.precision]


FORMS = {
    "linear": Form(),
    "finite": Form(finite=True),
    "two": Form(two=True),
    "two_finite": Form(finite=True, two=True),
    "linear_batch": Form(precision="float64"),
    "finite_batch": Form(finite=True, precision="float64"),
    "two_batch": Form(two=True, precision="float64"),
    "linear_single": Form(precision="float32"),
    "finite_single": Form(finite=True, precision="float32"),
    "two_single": Form(two=True, precision="float32"),
}


def request_of(run: Run, finite: bool = False, two: bool = False) -> Simulation:
    """The modal voice with finite stretch, or with two different folds."""
    model = Model(stretch="finite" if finite else "linear")
    return Simulation(run=run, model=model, left=LEFT if two else None)  # type: ignore[arg-type]  # made a Side


def glottis_of(run: Run, finite: bool = False, two: bool = False) -> Glottis:
    """The glottis of ``request_of``."""
    return prepare(request_of(run, finite, two)).glottis


def step_seconds(rounds: int) -> dict[str, list[float]]:
    """Seconds of a step of each of FORMS and glottis, in ``rounds`` times LAPS·BUFFERS turns after a warm-up."""
    alone = {name: _alone(form) for name, form in FORMS.items() if form.precision is None}
    batches = {name: _batch(form) for name, form in FORMS.items() if form.precision is not None}
    steps = dict.fromkeys(alone, PART_S / DEFAULT_STEP_S)
    steps |= {name: FORMS[name].glottises * BATCH_VOICE_S / DEFAULT_STEP_S for name in batches}
    took = turns(alone, rounds * LAPS * BUFFERS, TURN_S, time.thread_time)
    took |= turns(batches, rounds * LAPS, TURN_S, time.thread_time)
    return {name: [one / steps[name] for one in seconds] for name, seconds in took.items()}


def _alone(form: Form) -> Callable[[], object]:
    request = request_of(Run(), form.finite, form.two)
    glottis = prepare(request).glottis
    marches = [TimeMarch(glottis, DEFAULT_STEP_S, request.subglottal_pressure_pa) for _ in range(BUFFERS)]
    for march in marches:
        march.start(0, None)
        march.run(round(SETTLE_S / DEFAULT_STEP_S))
    samples, following = round(PART_S / DEFAULT_STEP_S), cycle(marches)
    return lambda: next(following).run(samples)


def _batch(form: Form) -> Callable[[], object]:
    request = request_of(Run(), form.finite, form.two)
    glottis = prepare(request).glottis
    one = MarchInput(glottis, DEFAULT_STEP_S, request.subglottal_pressure_pa, BATCH_VOICE_S)
    inputs, single = [one] * form.glottises, form.precision == "float32"
    return lambda: list(march_many(inputs, single_precision=single))
