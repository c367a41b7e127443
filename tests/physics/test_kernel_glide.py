"""The compiled glide against its twin: the same linear interpolation, stretch by stretch in Python."""

import numpy as np
import pytest

from tests.support.fold_harness import membrane
from vfcore.fold import assemble
from vfcore.fold.form import RECORD
from vfcore.fold.march import TimeMarch
from vfcore.runs.gesture.glide import STRETCH_STEPS, GlidingGlottis, GlottisSpec
from vfcore.runs.setup import glottis_of, postures_of
from vfcore.spec.request import resolve
from vfcore.spec.sides import folds_of
from vfcore.spec.simulation import DEFAULT_STEP_S

pytestmark = pytest.mark.kernel
STEPS, LOOK = 45, 20
KINDS = {
    "plain": {},
    "finite": {"model": {"stretch": "finite"}},
    "walls": {"right": {"activation": {"ta": 0.8}}},
    "lesion": {"lesions": [{"kind": "polyp", "side": "both"}]},
}


def spec(ct: float, kind: str = "plain") -> GlottisSpec:
    folds = folds_of(resolve({"activation": {"ct": ct}, "run": {"nx": 8, "ny": 4}} | KINDS[kind]))
    return GlottisSpec(folds, postures_of(folds))


def started(ct: float, kind: str) -> TimeMarch:
    march = TimeMarch(glottis_of(*spec(ct, kind)), DEFAULT_STEP_S, 800.0)
    march.start(0, None)
    return march


def twin(march: TimeMarch, to: assemble.Glottis, pressure: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Record (STEPS, columns) and the membrane of the first wall after LOOK steps."""
    here, there = (assemble.new_buffer(glottis, march.form, DEFAULT_STEP_S) for glottis in (march.glottis, to))
    moves = here != there
    record, seen = np.empty((STEPS, len(march.form.record))), None
    for begin in range(0, STEPS, STRETCH_STEPS):
        rows = slice(begin, min(begin + STRETCH_STEPS, STEPS))
        part = 0.5 * (rows.start + rows.stop) / STEPS
        march.buffer[moves] = (here + part * (there - here))[moves]
        march.advance(pressure[rows], 1, record[rows])
        if rows.stop == LOOK:
            seen = membrane(march).copy()
    return record, seen


@pytest.mark.parametrize("kind", KINDS)
def test_a_glide_equals_its_stretches(kind):
    """Tolerance 1e-11 of the largest value of each column: rounding of 45 steps from a bump of 1 nm."""
    to = spec(0.6, kind)
    gliding = GlidingGlottis(started(0.1, kind), spec(0.1, kind))
    record = gliding.advance(to, 1200.0, STEPS, LOOK)
    wanted, seen = twin(started(0.1, kind), glottis_of(*to), np.linspace(800.0, 1200.0, STEPS, endpoint=False))
    scale = np.nanmax(np.abs(wanted), axis=0, initial=1e-300)
    np.testing.assert_allclose(record / scale, wanted / scale, rtol=0, atol=1e-11)
    np.testing.assert_allclose(gliding.seen[0][0], seen, rtol=0, atol=1e-11 * np.abs(seen).max())
    still = gliding.advance(to, 1200.0, STEPS)
    assert (still[:, RECORD.index("glottal_flow_m3_s")] > 0).all(), "and the fold continues after the glide"
