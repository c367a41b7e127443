"""A vibrating fold whose geometry and tissue move under it.

The fold's equations hold at fixed material points: node (i, j) stays at x/L = i/(nx−1), y/b = j/(ny−1) while L, b and
the layers' depths change. The layers are incompressible, so the mass that belongs to a node does not change (ρ_s dx dy
and ρ_l dx are constant in λ), and m ẅ = F needs no further term: displacement and velocity are carried over as they
are, and every coefficient takes its present value. Left out, with their size in the fastest glide that is allowed
(docs/model.md): the inertia of the frame that turns with θ_g, and the speed of the medial plane in the contact damper.

Between the folds at both ends of a block every fixed number of the buffer moves along a straight line, in stretches of
STRETCH_STEPS; the middle of each is used, so the error is second order in it.
"""

import numpy as np

from vfcore import assemble
from vfcore.kernels.fold import LARGEST_DISPLACEMENT_M, step_kernel
from vfcore.kernels.glide import differing, glide_kernel
from vfcore.kernels.layout import RECORD, Layout
from vfcore.march import March, diverged

#: 0.3 ms at the default step. In CT 0.1 → 0.9 within 50 ms, stretches of a fifth of it change the sound by −40 dB.
STRETCH_STEPS = 10


class GlidingFold:
    """A fold under the step, block by block. ``fold`` and ``pressure_pa`` are those at the end of the last block."""

    def __init__(self, march: March):
        self.fold, self.pressure_pa = march.fold, march.pressure_pa
        self.time_step_s = march.time_step_s
        self.steps = 0
        self._buffer, self._scalars = march.buffer, march.scalars
        grid = (self.fold.nx, self.fold.ny, self.fold.rotation)
        self._advance, self._between = step_kernel(*grid), glide_kernel(*grid)
        self._air = None if march.air is None else march.air.copy()
        self._beyond = assemble.beyond(self._buffer, Layout(self.fold.nx, self.fold.ny))
        self._pressure = np.empty(0)
        self._layout = Layout(self.fold.nx, self.fold.ny)
        self._rest, self._rest_to = (assemble.new_buffer(self.fold, self.time_step_s) for _ in range(2))
        self._fixed, self._fixed_to = (assemble.fixed(rest, self._layout, 0) for rest in (self._rest, self._rest_to))
        self._places, self._way = np.empty(self._layout.size, np.int64), np.empty(self._layout.size)
        self._passing = np.empty_like(self._scalars)
        self.seen = self.shape()

    def advance(self, to: assemble.Fold, pressure_pa: float, steps: int, look_at: int = 0) -> np.ndarray:
        """Move to another fold of the same grid and another pressure in ``steps``; (steps, 7), layout.RECORD.

        ``look_at``: the step, a multiple of STRETCH_STEPS, after which ``seen`` is taken, 0 for not at all; looking
        changes nothing.
        Raises DivergenceError when the fold leaves all bounds.
        """
        record = np.empty((steps, len(RECORD)))
        if pressure_pa != self.pressure_pa or len(self._pressure) != steps or self._pressure[-1] != pressure_pa:
            self._pressure = np.linspace(self.pressure_pa, pressure_pa, steps, endpoint=False)
        pressure = self._pressure
        if to is self.fold:
            self._march(pressure, record, 0, look_at or steps)
            if look_at:
                self.seen = self.shape()
            self._march(pressure, record, look_at or steps, steps)
        else:
            self._glide(to, pressure, record, look_at)
        self.fold, self.pressure_pa = to, pressure_pa
        self.steps += steps
        if self._beyond.any():
            beyond = ~(np.abs(assemble.membrane(self._buffer, to)) < LARGEST_DISPLACEMENT_M)  # true for NaN
            if beyond.any():
                raise diverged(to, self.time_step_s, self.steps - 1, beyond)
        return record

    def shape(self) -> tuple[np.ndarray, np.ndarray]:
        """Present displacement (ny, nx) of the membrane and (nx,) of the beam; copies, m."""
        return assemble.membrane(self._buffer, self.fold).copy(), assemble.beam(self._buffer, self.fold).copy()

    def _march(self, pressure: np.ndarray, record: np.ndarray, begin: int, end: int) -> None:
        if begin < end:
            rows = record[begin:end].reshape(-1)
            self._advance(self._buffer, self._scalars, pressure[begin:end], 1, rows, self._air)

    def _glide(self, to: assemble.Fold, pressure: np.ndarray, record: np.ndarray, look_at: int) -> None:
        rest_to = self._rest_to
        assemble.refill(self._fixed_to, to, self.time_step_s)
        count = differing(self._rest, rest_to, self._places, self._way)  # state is 0 in both: geometry and tissue
        places, way = self._places[:count], self._way[:count]
        scalars_to = assemble.scalars(to, self.time_step_s)
        steps = len(pressure)
        for begin, end in ((0, look_at or steps), (look_at or steps, steps)):
            self._between(
                self._buffer, places, self._rest, way, self._passing, self._scalars, scalars_to,
                pressure, begin, end, STRETCH_STEPS, record.reshape(-1), self._air,
            )  # fmt: skip
            if end == look_at:
                self.seen = self.shape()
        self._buffer[places] = rest_to[places]
        self._rest, self._rest_to, self._scalars = rest_to, self._rest, scalars_to
        self._fixed, self._fixed_to = self._fixed_to, self._fixed
