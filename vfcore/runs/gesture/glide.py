"""A vibrating fold whose geometry and tissue change while it vibrates.

The equations of the fold hold at material points: node (i, j) stays at x/L = i/(nx−1), y/b = j/(ny−1) while L, b and
the depths of the layers change. The layers are incompressible, so the mass of a node does not change (ρ_s dx dy and
ρ_l dx are constant in λ), and m ẅ = F needs no further term: displacement and velocity stay as they are, and every
coefficient takes its present value. Two terms are neglected; docs/model/equations.md has their size in the fastest
permitted glide: the inertia of the frame that turns with θ_g, and the speed of the medial plane in the contact damper.

Within a block every fixed number of the buffer is interpolated linearly between the folds at both ends, in stretches of
STRETCH_STEPS at the value of the middle. The error is second order in the length of a stretch.
"""

from operator import attrgetter
from typing import NamedTuple

import numpy as np

from vfcore.errors import ParameterError
from vfcore.fold import assemble
from vfcore.fold.march import TimeMarch, diverged
from vfcore.fold.stability import SAFETY, longest_stable_step_s
from vfcore.kernels.fold import LARGEST_DISPLACEMENT_M, step_kernel
from vfcore.kernels.glide import glide_kernel
from vfcore.kernels.layout import RECORD, Layout
from vfcore.kernels.reassemble import reassemble_kernel
from vfcore.kernels.tissue import Constants
from vfcore.larynx.posture.solution import PostureSolution
from vfcore.runs.one import fold_of
from vfcore.spec.fold_constants import FoldConstants
from vfcore.spec.simulation import Model, Simulation

#: 0.357 ms at the default step. In CT 0.1 → 0.9 within 50 ms, stretches a fifth as long change the sound by −40 dB.
STRETCH_STEPS = 10


class FoldSpec(NamedTuple):
    """What a fold is assembled from: the request and the posture solved for it."""

    request: Simulation
    posture: PostureSolution


class GlidingFold:
    """A fold advanced block by block. ``spec`` and ``pressure_pa`` are those at the end of the last block."""

    def __init__(self, march: TimeMarch, spec: FoldSpec):
        fold = march.fold
        self.spec, self.pressure_pa = spec, march.pressure_pa
        self.time_step_s = march.time_step_s
        self.steps = 0
        self._fold: assemble.Fold | None = fold
        self._buffer, self._scalars = march.buffer, march.scalars
        grid = (fold.nx, fold.ny, fold.rotation)
        self._advance = step_kernel(*grid)
        self._advance_gliding = glide_kernel(*grid)
        self._write_fold = reassemble_kernel(*grid)
        self._air = None if march.air is None else march.air.copy()
        self._layout = layout = Layout(fold.nx, fold.ny)
        self._beyond = assemble.beyond(self._buffer, layout)
        self._w, self._w_b = assemble.membrane(self._buffer, fold), assemble.beam(self._buffer, fold)
        self._pressure = np.empty(0)
        self._rest, self._rest_to = (assemble.new_buffer(fold, self.time_step_s) for _ in range(2))
        self._scalars_to, self._passing = self._scalars.copy(), np.empty_like(self._scalars)
        self._difference, self._work = np.empty(layout.size), np.empty(3 * fold.nx)
        self._constants: FoldConstants | None = None
        self._model: Model | None = None
        self.seen = self.shape()

    @property
    def fold(self) -> assemble.Fold:
        """The fold of ``spec``, assembled on demand: the step does not need it."""
        if self._fold is None:
            self._fold = fold_of(*self.spec)
        return self._fold

    @property
    def medial_m(self) -> np.ndarray:
        """The medial plane (ny, nx) of ``spec``, m."""
        return assemble.membranes(self._rest, self._layout, "G")[:, :, 0]

    def advance(
        self, target: FoldSpec, pressure_pa: float, steps: int, look_at: int = 0, out: np.ndarray | None = None
    ) -> np.ndarray:
        """Move to the target, on the same grid, and to another pressure in ``steps``; (steps, 7), layout.RECORD.

        ``look_at``: the step, a multiple of STRETCH_STEPS, after which ``seen`` is set, 0 for none; the result does
        not depend on it. ``out``: array for the record, by default a new one.
        Raises ParameterError if the target needs a shorter step or has no stiffness left, DivergenceError if a
        displacement passes LARGEST_DISPLACEMENT_M.
        """
        gliding = target is not self.spec
        if gliding:
            self._reassemble(target)
        record = np.empty((steps, len(RECORD))) if out is None else out
        rows = record.reshape(-1)
        if pressure_pa != self.pressure_pa or len(self._pressure) != steps or self._pressure[-1] != pressure_pa:
            self._pressure = np.linspace(self.pressure_pa, pressure_pa, steps, endpoint=False)
        move = self._glide if gliding else self._march
        if 0 < look_at < steps:
            move(rows, 0, look_at)
            self.seen = self.shape()
            move(rows, look_at, steps)
        else:
            move(rows, 0, steps)
            if look_at:
                self.seen = self.shape()
        if gliding:
            self._rest, self._rest_to = self._rest_to, self._rest
            self._scalars, self._scalars_to = self._scalars_to, self._scalars
            self.spec, self._fold = target, None
        self.pressure_pa = pressure_pa
        self.steps += steps
        if self._beyond.any():
            beyond = ~(np.abs(self._w) < LARGEST_DISPLACEMENT_M)  # true for NaN
            if beyond.any():
                raise diverged(self.fold, self.time_step_s, self.steps - 1, beyond)
        return record

    def shape(self) -> tuple[np.ndarray, np.ndarray]:
        """Present displacement (ny, nx) of the membrane and (nx,) of the beam; copies, m."""
        return self._w.copy(), self._w_b.copy()

    def _march(self, rows: np.ndarray, begin: int, end: int) -> None:
        columns = len(RECORD)
        pressure, rows = self._pressure[begin:end], rows[columns * begin : columns * end]
        self._advance(self._buffer, self._scalars, pressure, 1, rows, self._air)

    def _glide(self, rows: np.ndarray, begin: int, end: int) -> None:
        self._advance_gliding(
            self._buffer,
            self._rest,
            self._rest_to,
            self._difference,
            self._passing,
            self._scalars,
            self._scalars_to,
            self._pressure,
            begin,
            end,
            STRETCH_STEPS,
            rows,
            self._air,
        )

    def _reassemble(self, target: FoldSpec) -> None:
        """Write the numbers of the target fold. ParameterError if it needs a shorter step or has no stiffness."""
        request, posture = target
        rest_angle = request.posture.rest_angle_rad if request.posture else request.constants.rest_angle_rad
        if request.constants is not self._constants or request.model is not self._model:
            self._constants, self._model = request.constants, request.model
            self._packed = packed(request.constants)
            self._inferior_stiff = request.model.coupling_gradient == "inferior_stiff"
        at = (posture.strain, request.activation.ta, posture.glottal_half_angle_rad, rest_angle)
        longest_s = self._write_fold(
            *map(float, (*at, request.convergence_angle_rad)),
            self._inferior_stiff,
            self.time_step_s,
            self._packed,
            self._rest_to,
            self._scalars_to,
            self._work,
        )
        if not SAFETY * longest_s >= self.time_step_s:
            check_step(fold_of(request, posture), self.time_step_s)


def check_step(fold: assemble.Fold, time_step_s: float) -> None:
    """ParameterError for a fold that needs a shorter step."""
    if longest_stable_step_s(fold) < time_step_s:
        raise ParameterError(
            "run.ny", f"{fold.nx}×{fold.ny} nodes need a shorter step than a gliding voice takes", "20×10 nodes"
        )


_numbers = attrgetter(*Constants._fields)


def packed(constants: FoldConstants) -> Constants:
    """The constants in the form that the kernel takes."""
    return Constants(*map(float, _numbers(constants)))
