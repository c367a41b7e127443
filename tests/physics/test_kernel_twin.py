"""The compiled step against the twin: the same scheme and step must give the same numbers.

Voices of 20 ms through onset, flow and contact, over postures, variants, grids, walls and material.
"""

from dataclasses import replace

import numpy as np
import pytest

from tests.support.fold_harness import (
    MODAL,
    advance,
    get_state,
    get_states,
    product_and_twin,
    product_of,
    put_state,
    put_states,
)
from tests.support.glottis_twin import GlottisTwin
from tests.support.patched_twin import patch_shape, patched
from tests.support.wall_twin import WallTwin
from vfcore.fold.constants import FoldConstants
from vfcore.fold.form import RECORD
from vfcore.fold.march import TimeMarch
from vfcore.spec.simulation import DEFAULT_STEP_S

OPEN_BACK = {"strain": -0.004, "a_ta": 0.4, "theta_g": 0.192}
SHORT = {"strain": -0.315, "a_ta": 1.0, "theta_g": 0.0}
LONG = {"strain": 0.23, "a_ta": 0.0, "theta_g": 0.018}

CASES = [
    MODAL,
    OPEN_BACK,
    SHORT,
    LONG,
    MODAL | {"coupling_gradient": "superior_stiff"},
    MODAL | {"shear": "rotation", "coupling_gradient": "superior_stiff"},
    LONG | {"shear": "rotation"},
    OPEN_BACK | {"nx": 12, "ny": 6},
    SHORT | {"nx": 12, "ny": 6, "shear": "rotation"},
    MODAL | {"nx": 21, "ny": 11},
    MODAL | {"theta_conv": 0.1, "alpha_s": 1.8, "mu_a_pa_s": 1e-3, "C_col_pa_s_m": 300.0},
]


ONE = WallTwin(**MODAL, nx=12, ny=6)


def swollen(wall, height_m):
    """A patch that stands out by ``height_m``, but not at x = 0: the folds meet there, and the step has no slice."""
    medial = wall.medial - height_m * patch_shape(wall)
    medial[0] = wall.medial[0]
    return patched(wall).with_fields(medial=medial)


#: Another posture, length, thickness and contact, so that every number of the two walls differs.
OTHER = WallTwin(0.12, 0.1, 0.06, 0.03, 12, 6, constants=FoldConstants(K_col_pa_m=4e6, C_col_pa_s_m=300.0, b_0_m=4e-3))
PAIR = (ONE, OTHER)
GLOTTISES = {
    "finite": (replace(ONE, stretch="finite"),),
    "finite, rotation": (replace(ONE, stretch="finite", shear="rotation"),),
    "finite, stretched": (WallTwin(**LONG, stretch="finite"),),
    "finite, odd grid": (WallTwin(**MODAL, nx=21, ny=11, stretch="finite"),),
    "two walls": PAIR,
    "two walls, rotation": tuple(replace(wall, shear="rotation") for wall in PAIR),
    "two walls, finite": tuple(replace(wall, stretch="finite") for wall in PAIR),
    "two walls, seven rows": tuple(replace(wall, ny=7) for wall in PAIR),
    "patch": (swollen(ONE, 2e-4),),
    "patch, rotation": (swollen(replace(ONE, shear="rotation"), 2e-4),),
    "patch, finite": (swollen(replace(ONE, stretch="finite"), 2e-4),),
    "a patch on one of two walls": (ONE, swollen(OTHER, 2e-4)),
    "everything": tuple(swollen(replace(wall, stretch="finite", shear="rotation"), 1e-4) for wall in PAIR),
}


def name_of(case):
    return "-".join(str(value) for value in case.values())


def closing_state(twin):
    """One half of the fold moves into contact, the other is open: all branches within a few steps."""
    x = twin.x[1:-1] / twin.k.L
    wave = (np.sin(3 * np.pi * x) + 0.3 * x)[:, None] * np.linspace(0.6, 1.2, twin.ny)
    w_m = twin.medial[1:-1] * 0.5 + 2e-4 * wave
    return twin.zero_state()._replace(w_m=w_m, w_b=0.5 * w_m[:, 0], v_m=0.2 * wave)


def compare(glottis, twin, start, pressure_pa, steps, dt=DEFAULT_STEP_S):
    """The record of the product from ``start``, a state of each wall, after comparison with the twin."""
    march = TimeMarch(glottis, dt, pressure_pa)
    put_states(march, start)
    record = advance(march, steps)
    reference = twin.march(start, pressure_pa, dt, steps, keep_every=1)
    for got, wanted in zip(get_states(march), reference.final, strict=True):
        for name, tolerance in (("w_m", 1e-12), ("w_b", 1e-12), ("phi", 1e-9)):
            assert np.abs(getattr(got, name) - getattr(wanted, name)).max() < tolerance, name
    same_record(march.form.record, record, reference, twin)
    return record


def same_record(names, record, reference, twin):
    column = dict(zip(names, record.T, strict=True))
    scale = max(1e-6, reference.A_g_min.max())
    assert np.abs(column["glottal_area_m2"] - reference.A_g_min).max() < 1e-10 * scale
    assert np.abs(column["glottal_flow_m3_s"] - reference.Q_g).max() < 1e-9 * max(1e-6, reference.Q_g.max())
    peak = np.maximum(reference.p_col_max, 0.0)  # the record has pushes only
    assert np.abs(column["contact_pressure_max_pa"] - peak).max() < 1e-9 * max(1.0, peak.max())
    pushed = peak > 1e-6
    assert np.isnan(column["contact_column"][reference.p_col_max <= 0]).all()
    assert (column["contact_column"][pushed] == reference.p_col_max_at[pushed, 0]).all()
    touching = np.array([twin.half_gap(states) < 0 for states in reference.states])
    width_x, width_y = np.full(touching.shape[1], twin.air.dx), np.full(touching.shape[2], twin.air.dy)
    width_x[[0, -1]] /= 2
    width_y[[0, -1]] /= 2
    area = touching @ width_y @ width_x
    assert np.abs(column["contact_area_m2"] - area).max() < 1e-12 * width_x.sum() * width_y.sum()
    if len(twin.walls) == 2:
        for side, name in enumerate(("left_edge_m", "right_edge_m")):
            wall, middle = twin.walls[side], (touching.shape[1] - 1) // 2
            edge = [(wall.medial - wall.whole(states[side].w_m))[middle].min() for states in reference.states]
            assert np.abs(column[name] - edge).max() < 1e-12, name


@pytest.mark.parametrize("case", CASES, ids=name_of)
def test_twenty_milliseconds_of_voice_equal_the_twin(case):
    glottis, twin = product_and_twin(**case)
    record = compare(glottis, twin.glottis, (twin.initial_state(),), 1000.0, 700)
    assert record[:, RECORD.index("glottal_flow_m3_s")].max() > 1e-4
    assert record[:, RECORD.index("contact_pressure_max_pa")].max() > 100 or case["theta_g"] > 0.1


@pytest.mark.parametrize("walls", GLOTTISES.values(), ids=GLOTTISES)
def test_finite_stretch_two_walls_and_patches_equal_the_twin(walls):
    twin = GlottisTwin(walls)
    record = compare(product_of(twin), twin, twin.initial_states(), 1500.0, 700)
    assert record[:, RECORD.index("glottal_flow_m3_s")].max() > 1e-4
    assert record[:, RECORD.index("contact_pressure_max_pa")].max() > 100


@pytest.mark.kernel
@pytest.mark.parametrize(("ny", "shear"), [(6, "kelvin_voigt"), (7, "kelvin_voigt"), (6, "rotation")])
def test_a_few_steps_through_contact_and_flow_equal_the_twin(ny, shear):
    """An even and an odd number of rows, because the gaps are computed in pairs of rows."""
    glottis, twin = product_and_twin(**MODAL, nx=12, ny=ny, shear=shear)
    record = compare(glottis, twin.glottis, (closing_state(twin),), 800.0, 40)
    assert record[:, RECORD.index("contact_pressure_max_pa")].max() > 100
    assert record[:, RECORD.index("glottal_flow_m3_s")].max() > 1e-5


@pytest.mark.kernel
@pytest.mark.parametrize("kind", ["two walls", "patch", "everything"])
def test_a_few_steps_of_walls_and_patches_through_contact_and_flow_equal_the_twin(kind):
    twin = GlottisTwin(GLOTTISES[kind])
    record = compare(product_of(twin), twin, tuple(map(closing_state, twin.walls)), 800.0, 40)
    assert record[:, RECORD.index("contact_pressure_max_pa")].max() > 100
    assert record[:, RECORD.index("glottal_flow_m3_s")].max() > 1e-5


@pytest.mark.kernel
def test_a_sparse_record_of_a_short_step_is_the_same_motion():
    glottis, twin = product_and_twin(**MODAL, nx=12, ny=6)
    start, dt = closing_state(twin), DEFAULT_STEP_S / 4
    reference = twin.run(start, 800.0, dt, 40)
    march = TimeMarch(glottis, dt, 800.0)
    put_state(march, start)
    record = march.run(10)
    assert march.record_every == 4
    assert np.abs(get_state(march).w_m - reference.final.w_m).max() < 1e-12
    flow = record[:, RECORD.index("glottal_flow_m3_s")]
    assert np.abs(flow - reference.Q_g[::4]).max() < 1e-9 * flow.max()


def test_a_rising_lung_pressure_equals_the_twin_under_the_same_ramp():
    glottis, twin = product_and_twin(**MODAL)
    rise = 0.010
    march = TimeMarch(glottis, DEFAULT_STEP_S, 1000.0, rise)
    march.start(0, None)
    advance(march, 700)
    reference = twin.run(twin.initial_state(), lambda t: 1000.0 * min(t / rise, 1.0), DEFAULT_STEP_S, 700)
    assert np.abs(get_state(march).w_m - reference.final.w_m).max() < 1e-12
    assert np.abs(reference.final.w_m).max() > 1e-4
