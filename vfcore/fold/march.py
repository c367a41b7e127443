"""Time march of a glottis: its state under the step, and the loop that advances it in chunks.

Between chunks of at most 40 ms of voice, progress is reported and a cancelled run stops.
"""

import math
from collections import deque
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from vfcore.airways.coupled import Airways
from vfcore.errors import Cancelled, DivergenceError
from vfcore.fold import assemble
from vfcore.fold.assemble import Glottis
from vfcore.fold.form import RECORD, StepForm
from vfcore.fold.layout import layout_of
from vfcore.fold.statics import StaticShape
from vfcore.fold.step import LARGEST_DISPLACEMENT_M, step_kernel
from vfcore.fold.surface import surface_pressures
from vfcore.spec.simulation import DEFAULT_STEP_S

CHUNK_S = 40e-3
#: Fine grids and short steps take shorter chunks: this many nodes times steps, about 10 ms of work.
CHUNK_NODE_STEPS = 5e6
#: A cycle can be read back if it begins within this time before the end of the run.
READABLE_S = 0.25
AT_REST = (0, 0, 1)  # nothing glides


class Glottises:
    """One glottis, or one per vector element, under the step: the buffer of their state and the compiled loop.

    ``air``: the buffer of the airways in a coupled form.
    """

    def __init__(self, glottises: Sequence[Glottis], form: StepForm, time_step_s: float, air: np.ndarray | None = None):
        self.glottises, self.form, self.time_step_s = glottises, form, time_step_s
        self.layout = layout_of(form)
        self.buffer = assemble.empty_buffer(self.layout)
        for place, one in enumerate(glottises):
            assemble.fill(self.buffer, self.layout, place, one, time_step_s)
        self.air = np.empty(0, self.buffer.dtype) if air is None else air
        self.record_every = record_every(time_step_s)
        self.beyond = assemble.beyond(self.buffer, self.layout)
        self.nothing = np.empty(0, self.buffer.dtype)
        self._kernel = step_kernel(form)

    def start(self, place: int, shapes: Sequence[StaticShape] | None) -> None:
        """The static shape of each wall, at rest; None: flat, with a bump of 1 nm."""
        at = self.buffer, self.layout, place, self.glottises[place]
        if shapes is None:
            assemble.start_flat(*at)
        else:
            assemble.start_static(*at, [(shape.w_m, shape.w_b) for shape in shapes])

    def advance(
        self,
        pressure: np.ndarray,
        every: int,
        record: np.ndarray,
        buffer: np.ndarray | None = None,
        air: np.ndarray | None = None,
        start: np.ndarray | None = None,
        target: np.ndarray | None = None,
        glide: tuple[int, int, int] = AT_REST,
    ) -> None:
        """Advance the own buffer, or ``buffer`` and ``air``, by one step per row of ``pressure`` (steps, glottises),
        as vfcore.fold.step.step_kernel says.
        """
        self._kernel(
            self.buffer if buffer is None else buffer,
            pressure.reshape(-1),
            every,
            record.reshape(-1),
            self.air if buffer is None else air,
            self.nothing if start is None else start,
            self.nothing if target is None else target,
            glide,
        )

    def displacements(self, buffer: np.ndarray, side: int) -> np.ndarray:
        """The membrane of a wall, (ny, nx, glottises), m; a view."""
        return assemble.membranes(buffer, self.layout, "w", side)

    def diverging(
        self, places: Sequence[int], before: np.ndarray, air: np.ndarray, steps: np.ndarray, pressure: np.ndarray
    ) -> Iterator[tuple[int, DivergenceError]]:
        """Repeat ``steps`` one by one from the state ``before`` (overwritten); of each of ``places`` when and where its
        displacement passed the bound.
        """
        wanted, scratch = list(places), np.empty((len(self.form.record), self.form.glottises), self.buffer.dtype)
        for step, now in zip(steps, pressure.reshape(len(steps), -1), strict=True):
            self.advance(now, 1, scratch, before, air)
            for place in [place for place in wanted if self.out_of_bounds(before, place) is not None]:
                yield place, self.divergence(before, place, int(step))
                wanted.remove(place)
            if not wanted:
                return

    def out_of_bounds(self, buffer: np.ndarray, place: int) -> tuple[int, int, int] | None:
        """Wall, row and column of a node whose displacement is beyond the bound or NaN; None if there is none."""
        for side in range(self.form.walls):
            out = ~(np.abs(self.displacements(buffer, side)[:, :, place]) < LARGEST_DISPLACEMENT_M)
            if out.any():
                j, i = np.argwhere(out)[0]
                return side, int(j), int(i)
        return None

    def divergence(self, buffer: np.ndarray, place: int, step: int) -> DivergenceError:
        """The error of a glottis whose displacement is out of bounds after ``step``."""
        found = self.out_of_bounds(buffer, place)
        assert found is not None
        side, j, i = found
        whose = ("the displacement", "the displacement of the left fold", "the displacement of the right fold")
        return DivergenceError(
            (step + 1) * self.time_step_s,
            i / (self.form.nx - 1),
            j / (self.form.ny - 1),
            f"{whose[0 if self.form.walls == 1 else side + 1]} passed {LARGEST_DISPLACEMENT_M * 1e3:g} mm",
            "Try a lower pressure or the constants' default values; if the same happens at a step below "
            f"{self.time_step_s:.3g} s, the step is not to blame.",
        )


class TimeMarch(Glottises):
    """State of one glottis under the step; time counts from its start.

    Every ``record_every``-th step is recorded, so the record has about 28 kHz for any time step. ``form``: one that
    covers the glottis, by default its own.
    """

    def __init__(
        self,
        glottis: Glottis,
        time_step_s: float,
        pressure_pa: float,
        rise_s: float = 0.0,
        airways: Airways | None = None,
        form: StepForm | None = None,
    ):
        air = airways.new_buffer(pressure_pa) if airways else None
        super().__init__([glottis], form or glottis.form(coupled=airways is not None), time_step_s, air)
        self.glottis = glottis
        self.pressure_pa, self.rise_s = pressure_pa, rise_s
        self.steps = 0
        self._per_chunk = samples_per_chunk(glottis, time_step_s)
        self._steady_pa = np.empty(0)
        kept = math.ceil(READABLE_S / (self._per_chunk * self.record_every * time_step_s))
        self._checkpoints: deque[tuple[int, np.ndarray, np.ndarray]] = deque(maxlen=kept)

    def pressure_at(self, steps: np.ndarray) -> np.ndarray:
        """Lung pressure at the given step numbers, Pa; do not write to it."""
        if self.rise_s > 0.0:
            return self.pressure_pa * np.minimum(steps * self.time_step_s / self.rise_s, 1.0)
        if len(steps) > len(self._steady_pa):
            self._steady_pa = np.full(len(steps), float(self.pressure_pa))
        return self._steady_pa[: len(steps)]

    def run(
        self,
        samples: int,
        progress: Callable[[float], None] | None = None,
        stop: Callable[[], bool] | None = None,
    ) -> np.ndarray:
        """Advance until ``samples`` are recorded; (samples, len(form.record)), form.record.

        Raises Cancelled if ``stop()`` returns true between chunks, DivergenceError if a displacement passes
        LARGEST_DISPLACEMENT_M.
        """
        record = np.empty((samples, len(self.form.record)))
        for begin in range(0, samples, self._per_chunk):
            if stop is not None and stop():
                raise Cancelled("the run was stopped")
            end = min(begin + self._per_chunk, samples)
            self._chunk(record[begin:end])
            if progress is not None:
                progress(end / samples)
        return record

    def _chunk(self, record: np.ndarray) -> None:
        before, air = self.buffer.copy(), self.air.copy()
        self._checkpoints.append((self.steps, before, air))
        steps = np.arange(self.steps, self.steps + len(record) * self.record_every)
        pressure = self.pressure_at(steps)
        self.advance(pressure, self.record_every, record)
        self.steps += len(steps)
        if self.beyond.any():
            for _, error in self.diverging([0], before.copy(), air.copy(), steps, pressure):
                raise error

    def cycle(self, first_sample: int, last_sample: int, phases: int) -> dict[str, np.ndarray]:
        """Fields at ``phases`` evenly spaced times in [first_sample, last_sample), recomputed from a checkpoint.

        Returns cycle_time_s (p,), cycle_w_m (walls, p, nx, ny) and cycle_wb_m (walls, p, nx), and of the pair of walls
        cycle_aerodynamic_pressure_pa, cycle_contact_pressure_pa (p, nx, ny). The state of the march does not change.
        """
        glottis, form, k = self.glottis, self.form, self.glottis.walls[0].constants
        wanted = np.linspace(first_sample, last_sample, phases, endpoint=False) * self.record_every
        wanted = np.round(wanted).astype(int)
        at, buffer, air = next(item for item in reversed(self._checkpoints) if item[0] <= wanted[0])
        buffer, air = buffer.copy(), air.copy()
        sides = range(form.walls)

        def of_each(view: Callable, name: str) -> np.ndarray:
            return np.array([view(buffer, self.layout, name, side)[..., 0] for side in sides])

        w_m = np.empty((form.walls, phases, form.ny, form.nx))
        w_b = np.empty((form.walls, phases, form.nx))
        p_aero, p_col = np.empty((2, phases, form.ny, form.nx))
        G = np.array([wall.medial_plane_m for wall in glottis.walls])
        scratch = np.empty(len(form.record))
        for phase, step in enumerate(wanted):
            if step > at:
                steps = np.arange(at, step)
                self.advance(self.pressure_at(steps), len(steps), scratch, buffer, air)
                at = step
            w_m[:, phase], w_b[:, phase] = of_each(assemble.membranes, "w"), of_each(assemble.beams, "w_b")
            speed = of_each(assemble.membranes, "v_star").mean(axis=0)
            inlet, outlet = self._glottal_pressures(buffer, air, step)
            surface_pressures(
                (G - w_m[:, phase]).mean(axis=0),
                speed,
                inlet,
                outlet,
                glottis.dy,
                k.alpha_s,
                0.5 * k.rho_a_kg_m3,
                12.0 * k.mu_a_pa_s,
                *glottis.contact,
                p_aero[phase],
                p_col[phase],
            )
        return {
            "cycle_time_s": wanted * self.time_step_s,
            "cycle_w_m": w_m.transpose(0, 1, 3, 2),
            "cycle_wb_m": w_b,
            "cycle_aerodynamic_pressure_pa": p_aero.transpose(0, 2, 1),
            "cycle_contact_pressure_pa": p_col.transpose(0, 2, 1),
        }

    def _glottal_pressures(self, buffer: np.ndarray, air: np.ndarray, step: int) -> tuple[float, float]:
        """Pressures at inlet and outlet, Pa, that the next step would use; the state does not change."""
        lungs = self.pressure_at(np.array([step]))
        if not self.form.coupled:
            return lungs[0], 0.0
        record = np.empty(len(self.form.record))
        self.advance(lungs, 1, record, buffer.copy(), air.copy())
        return record[RECORD.index("inlet_pressure_pa")], record[RECORD.index("outlet_pressure_pa")]

    @property
    def oldest_sample(self) -> int:
        """The first recorded sample that ``cycle`` can still recompute."""
        return -(-self._checkpoints[0][0] // self.record_every)


def record_every(time_step_s: float) -> int:
    """Steps per recorded sample; the record then has about 28 kHz for any time step."""
    return max(1, math.floor(DEFAULT_STEP_S / time_step_s + 1e-9))


def samples_per_chunk(glottis: Glottis, time_step_s: float) -> int:
    """Recorded samples per chunk, after which progress is reported, and stop and divergence are checked."""
    steps = min(CHUNK_S / time_step_s, CHUNK_NODE_STEPS / (glottis.nx * glottis.ny))
    return max(1, round(steps / record_every(time_step_s)))
