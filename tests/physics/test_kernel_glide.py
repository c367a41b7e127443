"""The compiled glide against its twin: the same linear interpolation, stretch by stretch in Python."""

import numpy as np
import pytest

from vfcore.fold import assemble
from vfcore.fold.form import RECORD
from vfcore.fold.march import TimeMarch
from vfcore.fold.step import step_kernel
from vfcore.runs.gesture.glide import STRETCH_STEPS, FoldSpec, GlidingFold
from vfcore.runs.setup import fold_of, posture_of
from vfcore.spec.simulation import DEFAULT_STEP_S, Activation, Run, Simulation

pytestmark = pytest.mark.kernel
STEPS, LOOK = 45, 20


def spec(ct: float) -> FoldSpec:
    request = Simulation(activation=Activation(ct=ct), run=Run(nx=8, ny=4))
    return FoldSpec(request, posture_of(request))


def started(ct: float) -> TimeMarch:
    march = TimeMarch(fold_of(*spec(ct)), DEFAULT_STEP_S, 800.0)
    march.start_flat()
    return march


def twin(march: TimeMarch, to: assemble.Fold, pressure: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Record (STEPS, 7) and the membrane after LOOK steps."""
    here, there = (assemble.new_buffer(fold, DEFAULT_STEP_S) for fold in (march.fold, to))
    moves, par = here != there, assemble.scalars(to, DEFAULT_STEP_S)
    step = step_kernel(to.nx, to.ny, to.rotation)
    record, seen = np.empty((STEPS, len(RECORD))), None
    for begin in range(0, STEPS, STRETCH_STEPS):
        rows = slice(begin, min(begin + STRETCH_STEPS, STEPS))
        part = 0.5 * (rows.start + rows.stop) / STEPS
        march.buffer[moves] = (here + part * (there - here))[moves]
        step(march.buffer, march.scalars + part * (par - march.scalars), pressure[rows], 1, record[rows].reshape(-1))
        if rows.stop == LOOK:
            seen = assemble.membrane(march.buffer, to).copy()
    return record, seen


def test_a_glide_equals_its_stretches():
    """Tolerance 1e-11 of the largest value of each column: rounding of 45 steps from a bump of 1 nm."""
    to = spec(0.6)
    gliding = GlidingFold(started(0.1), spec(0.1))
    record = gliding.advance(to, 1200.0, STEPS, LOOK)
    wanted, seen = twin(started(0.1), fold_of(*to), np.linspace(800.0, 1200.0, STEPS, endpoint=False))
    scale = np.abs(wanted).max(axis=0) + 1e-300
    np.testing.assert_allclose(record / scale, wanted / scale, rtol=0, atol=1e-11)
    np.testing.assert_allclose(gliding.seen[0], seen, rtol=0, atol=1e-11 * np.abs(seen).max())
    still = gliding.advance(to, 1200.0, STEPS)
    assert (still[:, RECORD.index("glottal_flow_m3_s")] > 0).all(), "and the fold continues after the glide"
