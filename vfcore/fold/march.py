"""Time march of one fold: its state, and the loop that advances it in chunks.

Between chunks of at most 40 ms of voice, progress is reported and a cancelled run stops.
"""

import math
from collections import deque
from collections.abc import Callable

import numpy as np

from vfcore.airways.coupled import Airways
from vfcore.errors import Cancelled, DivergenceError
from vfcore.fold import assemble
from vfcore.fold.statics import StaticShape
from vfcore.kernels.fold import LARGEST_DISPLACEMENT_M, step_kernel
from vfcore.kernels.layout import RECORD, Layout
from vfcore.kernels.surface import surface_pressures
from vfcore.spec.simulation import DEFAULT_STEP_S

CHUNK_S = 40e-3
#: Fine grids and short steps take shorter chunks: this many nodes times steps, about 10 ms of work.
CHUNK_NODE_STEPS = 5e6
FLAT_BUMP_M = 1e-9  # initial displacement of a flat start, as in an earlier version of the model
#: A cycle can be read back if it begins within this time before the end of the run.
READABLE_S = 0.25


class TimeMarch:
    """State of one fold under the step; time counts from its start.

    Every ``record_every``-th step is recorded, so the record has about 28 kHz for any time step.
    """

    def __init__(
        self,
        fold: assemble.Fold,
        time_step_s: float,
        pressure_pa: float,
        rise_s: float = 0.0,
        airways: Airways | None = None,
    ):
        self.fold = fold
        self.time_step_s = time_step_s
        self.pressure_pa, self.rise_s = pressure_pa, rise_s
        self.record_every = record_every(time_step_s)
        self.buffer = assemble.new_buffer(fold, time_step_s)
        self._beyond = assemble.beyond(self.buffer, Layout(fold.nx, fold.ny))
        self.scalars = assemble.scalars(fold, time_step_s)
        self.steps = 0
        self.air = airways.new_buffer(pressure_pa) if airways else None
        self._advance = step_kernel(fold.nx, fold.ny, fold.rotation)
        self._per_chunk = samples_per_chunk(fold, time_step_s)
        self._steady_pa = np.empty(0)
        kept = math.ceil(READABLE_S / (self._per_chunk * self.record_every * time_step_s))
        self._checkpoints: deque[tuple[int, np.ndarray, np.ndarray | None]] = deque(maxlen=kept)

    def start_flat(self) -> None:
        """w = 1 nm · sin(πx/L) sin(πy/b), everything else at rest."""
        assemble.membrane(self.buffer, self.fold)[:] = flat_bump(self.fold)

    def start_static(self, shape: StaticShape) -> None:
        """The static shape, at rest. With the rotation equation φ = ∂_y w, so that the shear is 0."""
        assemble.membrane(self.buffer, self.fold)[:] = shape.w_m
        assemble.beam(self.buffer, self.fold)[:] = shape.w_b
        if self.fold.rotation:
            assemble.membrane(self.buffer, self.fold, "phi")[:-1] = np.diff(shape.w_m, axis=0) / self.fold.dy

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
        """Advance until ``samples`` are recorded; (samples, len(RECORD)), layout.RECORD.

        Raises Cancelled if ``stop()`` returns true between chunks, DivergenceError if a displacement passes
        LARGEST_DISPLACEMENT_M.
        """
        record = np.empty((samples, len(RECORD)))
        for begin in range(0, samples, self._per_chunk):
            if stop is not None and stop():
                raise Cancelled("the run was stopped")
            end = min(begin + self._per_chunk, samples)
            self._chunk(record[begin:end])
            if progress is not None:
                progress(end / samples)
        return record

    def _chunk(self, record: np.ndarray) -> None:
        before, air = self.buffer.copy(), _copied(self.air)
        self._checkpoints.append((self.steps, before, air))
        steps = np.arange(self.steps, self.steps + len(record) * self.record_every)
        pressure = self.pressure_at(steps)
        self._advance(self.buffer, self.scalars, pressure, self.record_every, record.reshape(-1), self.air)
        self.steps += len(steps)
        if self._beyond.any():
            self._locate_divergence(before.copy(), _copied(air), steps)

    def _locate_divergence(self, buffer: np.ndarray, air: np.ndarray | None, steps: np.ndarray) -> None:
        scratch = np.empty(len(RECORD))
        for step in steps:
            self._advance(buffer, self.scalars, self.pressure_at(np.array([step])), 1, scratch, air)
            beyond = ~(np.abs(assemble.membrane(buffer, self.fold)) < LARGEST_DISPLACEMENT_M)
            if beyond.any():
                raise diverged(self.fold, self.time_step_s, step, beyond)

    def cycle(self, first_sample: int, last_sample: int, phases: int) -> dict[str, np.ndarray]:
        """Fields at ``phases`` evenly spaced times in [first_sample, last_sample), recomputed from a checkpoint.

        Returns cycle_time_s (p,), cycle_w_m, cycle_aerodynamic_pressure_pa, cycle_contact_pressure_pa (p, nx, ny)
        and cycle_wb_m (p, nx). The state of the march does not change.
        """
        fold, k = self.fold, self.fold.constants
        wanted = np.linspace(first_sample, last_sample, phases, endpoint=False) * self.record_every
        wanted = np.round(wanted).astype(int)
        at, buffer, air = next(item for item in reversed(self._checkpoints) if item[0] <= wanted[0])
        buffer, air = buffer.copy(), _copied(air)
        w, velocity = (assemble.membrane(buffer, fold, name) for name in ("w", "v_star"))
        beam = assemble.beam(buffer, fold)
        shape = (phases, fold.ny, fold.nx)
        w_m, p_aero, p_col = np.empty(shape), np.empty(shape), np.empty(shape)
        w_b = np.empty((phases, fold.nx))
        scratch = np.empty(len(RECORD))
        for phase, step in enumerate(wanted):
            if step > at:
                steps = np.arange(at, step)
                self._advance(buffer, self.scalars, self.pressure_at(steps), len(steps), scratch, air)
                at = step
            w_m[phase], w_b[phase] = w, beam
            inlet, outlet = self._glottal_pressures(buffer, air, step)
            surface_pressures(
                w_m[phase],
                velocity,
                fold.medial_plane_m,
                inlet,
                outlet,
                fold.dy,
                k.alpha_s,
                0.5 * k.rho_a_kg_m3,
                12.0 * k.mu_a_pa_s,
                k.K_col_pa_m,
                k.C_col_pa_s_m,
                p_aero[phase],
                p_col[phase],
            )
        return {
            "cycle_time_s": wanted * self.time_step_s,
            "cycle_w_m": w_m.transpose(0, 2, 1),
            "cycle_wb_m": w_b,
            "cycle_aerodynamic_pressure_pa": p_aero.transpose(0, 2, 1),
            "cycle_contact_pressure_pa": p_col.transpose(0, 2, 1),
        }

    def _glottal_pressures(self, buffer: np.ndarray, air: np.ndarray | None, step: int) -> tuple[float, float]:
        """Pressures at inlet and outlet, Pa, that the next step would use; the state does not change."""
        lungs = self.pressure_at(np.array([step]))
        if air is None:
            return lungs[0], 0.0
        record = np.empty(len(RECORD))
        self._advance(buffer.copy(), self.scalars, lungs, 1, record, _copied(air))
        return record[RECORD.index("inlet_pressure_pa")], record[RECORD.index("outlet_pressure_pa")]

    @property
    def oldest_sample(self) -> int:
        """The first recorded sample that ``cycle`` can still recompute."""
        return -(-self._checkpoints[0][0] // self.record_every)


def _copied(air: np.ndarray | None) -> np.ndarray | None:
    return None if air is None else air.copy()


def record_every(time_step_s: float) -> int:
    """Steps per recorded sample; the record then has about 28 kHz for any time step."""
    return max(1, math.floor(DEFAULT_STEP_S / time_step_s + 1e-9))


def samples_per_chunk(fold: assemble.Fold, time_step_s: float) -> int:
    """Recorded samples per chunk, after which progress is reported, and stop and divergence are checked."""
    steps = min(CHUNK_S / time_step_s, CHUNK_NODE_STEPS / (fold.nx * fold.ny))
    return max(1, round(steps / record_every(time_step_s)))


def flat_bump(fold: assemble.Fold) -> np.ndarray:
    """1 nm · sin(πx/L) sin(πy/b), (ny, nx)."""
    bump = np.sin(np.pi * fold.y_m / fold.y_m[-1])[:, None] * np.sin(np.pi * fold.x_m / fold.x_m[-1])
    bump[[0, -1]], bump[:, [0, -1]] = 0.0, 0.0  # exact zeros: sin(π) is not
    return FLAT_BUMP_M * bump


def diverged(fold: assemble.Fold, time_step_s: float, step: int, beyond: np.ndarray) -> DivergenceError:
    """The error of a fold whose displacement is out of bounds after ``step`` at the nodes ``beyond`` (ny, nx)."""
    j, i = np.argwhere(beyond)[0]
    return DivergenceError(
        (step + 1) * time_step_s,
        i / (fold.nx - 1),
        j / (fold.ny - 1),
        f"the displacement passed {LARGEST_DISPLACEMENT_M * 1e3:g} mm",
        "Try a lower pressure or the constants' default values; if the same happens at a step below "
        f"{time_step_s:.3g} s, the step is not to blame.",
    )
