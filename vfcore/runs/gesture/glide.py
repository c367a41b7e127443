"""A vibrating glottis whose geometry and tissue change while it vibrates.

The equations of the fold hold at material points: node (i, j) stays at x/L = i/(nx−1), y/b = j/(ny−1) while L, b and
the depths of the layers change. The layers are incompressible, so the mass of a node does not change (ρ_s dx dy and
ρ_l dx are constant in λ), and m ẅ = F needs no further term: displacement and velocity stay as they are, and every
coefficient takes its present value. Two terms are neglected; docs/model/equations.md has their size in the fastest
permitted glide: the inertia of the frame that turns with θ_g, and the speed of the medial plane in the contact damper.

Within a block every fixed number of the buffer is interpolated linearly between the folds at both ends, in stretches of
STRETCH_STEPS at the value of the middle. The error is second order in the length of a stretch.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from vfcore.errors import ParameterError
from vfcore.fold import assemble
from vfcore.fold.assemble import Glottis
from vfcore.fold.layout import BEAM, ROTATION, STATE
from vfcore.fold.march import AT_REST, TimeMarch
from vfcore.fold.stability import longest_stable_step_s
from vfcore.larynx.posture.solution import PostureSolution
from vfcore.runs.setup import glottis_of
from vfcore.spec.simulation import Simulation

#: 0.357 ms at the default step. In CT 0.1 → 0.9 within 50 ms, stretches a fifth as long change the sound by −40 dB.
STRETCH_STEPS = 10


class GlottisSpec(NamedTuple):
    """What a glottis is assembled from: the request of each fold, and the posture solved for it."""

    folds: tuple[Simulation, ...]
    postures: tuple[PostureSolution, ...]


class GlidingGlottis:
    """A glottis advanced block by block. ``spec`` and ``pressure_pa`` are those at the end of the last block."""

    def __init__(self, march: TimeMarch, spec: GlottisSpec):
        self.spec, self.pressure_pa = spec, march.pressure_pa
        self.time_step_s = march.time_step_s
        self.steps = 0
        self._pressure = np.empty(0)
        self._take(march)
        self.seen = self.shape()

    def _take(self, march: TimeMarch) -> None:
        """Go on from the state of ``march``, in its form."""
        self._march, self.glottis, self.form = march, march.glottis, march.form
        self._layout, self._fixed = march.layout, march.layout.fixed
        self._rest, self._rest_to = march.buffer.copy(), march.buffer.copy()

    def _fit(self, glottis: Glottis) -> None:
        """Change to a form that also covers ``glottis``, if the present one does not: two walls instead of one, or
        material that varies over the surface. The state is carried over; a mirror image becomes a fold of its own.
        """
        wanted = self.form.covering(glottis.form(coupled=self.form.coupled))
        if wanted == self.form:
            return
        old, before = self._march, self.form
        march = TimeMarch(self.glottis.with_walls(wanted.walls), self.time_step_s, old.pressure_pa, form=wanted)
        march.air = old.air
        for side in range(wanted.walls):
            of = min(side, before.walls - 1)
            for view, names in (
                (assemble.membranes, STATE + (ROTATION if wanted.rotation else ())),
                (assemble.beams, BEAM),
            ):
                for name in names:
                    view(march.buffer, march.layout, name, side)[:] = view(old.buffer, old.layout, name, of)
        assemble.beams(march.buffer, march.layout, "half_min")[:] = assemble.beams(old.buffer, old.layout, "half_min")
        self._take(march)
        w, w_b = (np.repeat(part, wanted.walls // before.walls, axis=0) for part in self.seen)
        self.seen = w, w_b

    @property
    def medial_m(self) -> np.ndarray:
        """The medial plane of each wall of ``spec``, (walls, ny, nx), m."""
        return np.array([wall.medial_plane_m for wall in self.glottis.walls])

    def advance(
        self, target: GlottisSpec, pressure_pa: float, steps: int, look_at: int = 0, out: np.ndarray | None = None
    ) -> np.ndarray:
        """Move to the target, of the same form, and to another pressure in ``steps``; (steps, columns), form.record.

        ``look_at``: the step, a multiple of STRETCH_STEPS, after which ``seen`` is set, 0 for none; the result does
        not depend on it. ``out``: array for the record, by default a new one.
        Raises ParameterError if the target needs a shorter step or has no stiffness left, DivergenceError if a
        displacement passes LARGEST_DISPLACEMENT_M.
        """
        gliding = target is not self.spec
        glottis = self.glottis
        if gliding:
            glottis = glottis_of(*target)
            check_step(glottis, self.time_step_s)
            self._fit(glottis)
            glottis = glottis.with_walls(self.form.walls)
            assemble.fill(self._rest_to, self._layout, 0, glottis, self.time_step_s)
        if out is None or out.shape[1] != len(self.form.record):
            out = np.empty((steps, len(self.form.record)))
        record = out
        if pressure_pa != self.pressure_pa or len(self._pressure) != steps or self._pressure[-1] != pressure_pa:
            self._pressure = np.linspace(self.pressure_pa, pressure_pa, steps, endpoint=False)
        for begin, end in ((0, look_at), (look_at, steps)) if 0 < look_at < steps else ((0, steps),):
            self._move(record, begin, end, gliding)
            if end == look_at:
                self.seen = self.shape()
        if gliding:
            self._rest, self._rest_to = self._rest_to, self._rest
            self._march.buffer[self._fixed :] = self._rest[self._fixed :]
            self.spec, self.glottis = target, glottis
        self.pressure_pa = pressure_pa
        self.steps += steps
        if self._march.beyond.any() and self._march.out_of_bounds(self._march.buffer, 0) is not None:
            raise self._march.divergence(self._march.buffer, 0, self.steps - 1)
        return record

    def shape(self) -> tuple[np.ndarray, np.ndarray]:
        """Present displacement (walls, ny, nx) of the membranes and (walls, nx) of the beams; copies, m."""
        return self._of_each(assemble.membranes, "w"), self._of_each(assemble.beams, "w_b")

    def _of_each(self, view: Callable, name: str) -> np.ndarray:
        buffer, sides = self._march.buffer, range(self.form.walls)
        return np.array([view(buffer, self._layout, name, side)[..., 0] for side in sides])

    def _move(self, record: np.ndarray, begin: int, end: int, gliding: bool) -> None:
        """Advance steps ``begin`` to ``end`` of a block."""
        start = target = None
        glide = AT_REST
        if gliding:
            start, target = self._rest[self._fixed :], self._rest_to[self._fixed :]
            glide = (STRETCH_STEPS, begin, len(self._pressure))
        self._march.advance(self._pressure[begin:end], 1, record[begin:end], start=start, target=target, glide=glide)


def check_step(glottis: Glottis, time_step_s: float) -> None:
    """ParameterError for a glottis that needs a shorter step."""
    if longest_stable_step_s(glottis) < time_step_s:
        raise ParameterError(
            "run.ny", f"{glottis.nx}×{glottis.ny} nodes need a shorter step than a gliding voice takes", "20×10 nodes"
        )
