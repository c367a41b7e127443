"""A vibrating fold whose geometry and tissue move under it.

The fold's equations hold at fixed material points: node (i, j) stays at x/L = i/(nx−1), y/b = j/(ny−1) while L, b and
the layers' depths change. The layers are incompressible, so the mass that belongs to a node does not change (ρ_s dx dy
and ρ_l dx are constant in λ), and m ẅ = F needs no further term: displacement and velocity are carried over as they
are, and every coefficient takes its present value. Left out, with their size in the fastest glide that is allowed
(docs/model/equations.md): the inertia of the frame that turns with θ_g, and the speed of the medial plane in the
contact damper.

Between the folds at both ends of a block every fixed number of the buffer moves along a straight line, in stretches of
STRETCH_STEPS; the middle of each is used, so the error is second order in it.
"""

from operator import attrgetter
from typing import NamedTuple

import numpy as np

from vfcore.errors import ParameterError
from vfcore.fold import assemble
from vfcore.fold.march import March, diverged
from vfcore.fold.stability import SAFETY, longest_stable_step_s
from vfcore.kernels.fold import LARGEST_DISPLACEMENT_M, step_kernel
from vfcore.kernels.glide import glide_kernel
from vfcore.kernels.layout import RECORD, Layout
from vfcore.kernels.reassemble import target_kernel
from vfcore.kernels.tissue import Constants
from vfcore.larynx.posture.solution import PostureSolution
from vfcore.runs.one import fold_of
from vfcore.spec.fold_constants import FoldConstants
from vfcore.spec.simulation import Model, Simulation

#: 0.3 ms at the default step. In CT 0.1 → 0.9 within 50 ms, stretches of a fifth of it change the sound by −40 dB.
STRETCH_STEPS = 10


class Goal(NamedTuple):
    """What a fold is made of: the request and the posture that was found for it."""

    request: Simulation
    posture: PostureSolution


class GlidingFold:
    """A fold under the step, block by block. ``goal`` and ``pressure_pa`` are those at the end of the last block."""

    def __init__(self, march: March, goal: Goal):
        fold = march.fold
        self.goal, self.pressure_pa = goal, march.pressure_pa
        self.time_step_s = march.time_step_s
        self.steps = 0
        self._fold: assemble.Fold | None = fold
        self._buffer, self._scalars = march.buffer, march.scalars
        grid = (fold.nx, fold.ny, fold.rotation)
        self._advance, self._between, self._fill = step_kernel(*grid), glide_kernel(*grid), target_kernel(*grid)
        self._air = None if march.air is None else march.air.copy()
        self._layout = layout = Layout(fold.nx, fold.ny)
        self._beyond = assemble.beyond(self._buffer, layout)
        self._w, self._w_b = assemble.membrane(self._buffer, fold), assemble.beam(self._buffer, fold)
        self._pressure = np.empty(0)
        self._rest, self._rest_to = (assemble.new_buffer(fold, self.time_step_s) for _ in range(2))
        self._scalars_to, self._passing = self._scalars.copy(), np.empty_like(self._scalars)
        self._way, self._work = np.empty(layout.size), np.empty(3 * fold.nx)
        self._constants: FoldConstants | None = None
        self._model: Model | None = None
        self.seen = self.shape()

    @property
    def fold(self) -> assemble.Fold:
        """The fold of ``goal``, made when it is asked for: the step has its own numbers of it."""
        if self._fold is None:
            self._fold = fold_of(*self.goal)
        return self._fold

    @property
    def medial_m(self) -> np.ndarray:
        """The medial plane (ny, nx) of ``goal``, m."""
        return assemble.membranes(self._rest, self._layout, "G")[:, :, 0]

    def advance(
        self, to: Goal, pressure_pa: float, steps: int, look_at: int = 0, out: np.ndarray | None = None
    ) -> np.ndarray:
        """Move to another goal of the same grid and another pressure in ``steps``; (steps, 7), layout.RECORD.

        ``look_at``: the step, a multiple of STRETCH_STEPS, after which ``seen`` is taken, 0 for not at all; looking
        changes nothing. ``out``: where the record goes, a new array without it.
        Raises ParameterError for a goal that cannot be reached with this step or has no stiffness left, and
        DivergenceError when the fold leaves all bounds.
        """
        gliding = to is not self.goal
        if gliding:
            self._aim(to)
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
            self.goal, self._fold = to, None
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
        self._between(
            self._buffer, self._rest, self._rest_to, self._way, self._passing, self._scalars, self._scalars_to,
            self._pressure, begin, end, STRETCH_STEPS, rows, self._air,
        )  # fmt: skip

    def _aim(self, to: Goal) -> None:
        """Have the numbers of ``to`` ready, or say why there are none."""
        request, posture = to
        rest_angle = request.posture.rest_angle_rad if request.posture else request.constants.rest_angle_rad
        if request.constants is not self._constants or request.model is not self._model:
            self._constants, self._model = request.constants, request.model
            self._packed = packed(request.constants)
            self._inferior_stiff = request.model.coupling_gradient == "inferior_stiff"
        at = (posture.strain, request.activation.ta, posture.glottal_half_angle_rad, rest_angle)
        longest_s = self._fill(
            *map(float, (*at, request.convergence_angle_rad)), self._inferior_stiff, self.time_step_s,
            self._packed, self._rest_to, self._scalars_to, self._work,
        )  # fmt: skip
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
    """The constants as the kernel takes them."""
    return Constants(*map(float, _numbers(constants)))
