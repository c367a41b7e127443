"""The direct static solve against the relaxation of the twin and against damped motion of the step."""

from dataclasses import replace

import numpy as np
import pytest

from tests.support.fold_harness import (
    MODAL,
    SHEARS,
    advance,
    beam,
    get_state,
    membrane,
    product_and_twin,
    product_of,
)
from tests.support.glottis_twin import GlottisTwin
from tests.support.patched_twin import patched
from tests.support.wall_twin import WallTwin
from vfcore.fold.constants import FoldConstants
from vfcore.fold.march import TimeMarch
from vfcore.fold.stability import time_step_s
from vfcore.fold.statics import static_shapes_of
from vfcore.runs.setup import prepare
from vfcore.spec.request import resolve
from vfcore.spec.simulation import DEFAULT_STEP_S, Run

POSTURES = {
    "modal, closed": MODAL,
    "posterior opening": {"strain": 0.022, "a_ta": 0.4, "theta_g": 0.06},
    "wide open": {"strain": -0.004, "a_ta": 0.4, "theta_g": 0.192},
    "short, pressed": {"strain": -0.315, "a_ta": 1.0, "theta_g": 0.0},
    "long, straight": {"strain": 0.23, "a_ta": 0.0, "theta_g": 0.018},
    "bowed": {"strain": 0.1, "a_ta": 0.0, "theta_g": 0.0},
    "diverging": MODAL | {"theta_conv": -0.02},
    "superior edge stiff": MODAL | {"coupling_gradient": "superior_stiff"},
    "hard contact": MODAL | {"K_col_pa_m": 1e8},
    "odd grid": {"strain": 0.022, "a_ta": 0.4, "theta_g": 0.06, "nx": 21, "ny": 11},
}
HEAVY = FoldConstants(C_coup_pa_s_m=150.0, C_foun_pa_s=40.0)
CASES = pytest.mark.parametrize(
    ("posture", "shear"),
    [(posture, shear) for posture in POSTURES.values() for shear in SHEARS],
    ids=[f"{name}, {shear}" for name in POSTURES for shear in SHEARS],
)


@CASES
def test_the_direct_solve_equals_the_twins_relaxation(posture, shear):
    glottis, twin = product_and_twin(**posture, shear=shear)
    [shape] = static_shapes_of(glottis)
    w_m, w_b = twin.static_shape_reference(error_m=1e-9)
    assert np.abs(shape.w_m.T - w_m).max() < 1e-6 * twin.k.L
    assert np.abs(shape.w_b - w_b).max() < 1e-6 * twin.k.L


@CASES
def test_the_direct_solve_equals_the_damped_motion_from_flat(posture, shear):
    glottis, twin = product_and_twin(**posture, shear=shear)
    heavy, _ = product_and_twin(**posture, shear=shear, C_coup_pa_s_m=150.0, C_foun_pa_s=40.0)
    [shape] = static_shapes_of(glottis)
    step = time_step_s(Run(), heavy)
    march = TimeMarch(heavy, step, 0.0)
    march.start(0, None)
    advance(march, round(0.5 / step))
    assert np.abs(membrane(march) - shape.w_m).max() < 1e-6 * twin.k.L
    assert np.abs(beam(march) - shape.w_b).max() < 1e-6 * twin.k.L


@CASES
def test_every_force_balances_at_the_static_shape(posture, shear):
    """Accelerations at the static shape, relative to that of a 1 nm displacement of the slowest mode."""
    glottis, twin = product_and_twin(**posture, shear=shear)
    [shape] = static_shapes_of(glottis)
    phi = np.diff(shape.w_m, axis=0)[:, 1:-1].T / twin.dy if shear == "rotation" else twin.zero_state().phi
    rest = twin.zero_state()._replace(w_m=shape.w_m[:, 1:-1].T, w_b=shape.w_b[1:-1], phi=phi)
    a_m, a_b, _ = twin.acceleration(rest, 0.0)
    scale = 1e-9 * (2 * np.pi * twin.mode_frequencies(1)[0]) ** 2
    assert np.abs(a_m).max() < scale and np.abs(a_b).max() < scale
    assert shape.iterations <= 10


@pytest.mark.parametrize("shear", SHEARS)
@pytest.mark.parametrize("name", ["modal, closed", "wide open", "bowed"])
def test_a_run_from_the_static_shape_without_pressure_stays_there(name, shear):
    glottis, _ = product_and_twin(**POSTURES[name], shear=shear)
    shape, march = static_shapes_of(glottis)[0], TimeMarch(glottis, DEFAULT_STEP_S, 0.0)
    march.start(0, [shape])
    advance(march, 700)
    assert np.abs(membrane(march) - shape.w_m).max() < 1e-12
    assert np.abs(get_state(march).w_b - shape.w_b[1:-1]).max() < 1e-12
    assert np.abs(shape.w_m).max() > 1e-5


#: Glottises of the twin, by what their static shape needs beyond one uniform fold.
ONE, OTHER = WallTwin(**MODAL), WallTwin(0.12, 0.1, 0.06)
GLOTTISES = {
    "finite": (replace(ONE, stretch="finite"),),
    "finite, bowed": (WallTwin(0.1, 0.0, 0.0, stretch="finite"),),
    "finite, rotation": (replace(ONE, stretch="finite", shear="rotation"),),
    "two walls": (ONE, OTHER),
    "two walls, finite": tuple(replace(wall, stretch="finite") for wall in (ONE, OTHER)),
    "patch": (patched(ONE, bump_m=3e-4),),
    "everything": tuple(patched(replace(wall, stretch="finite"), bump_m=2e-4) for wall in (ONE, OTHER)),
}


@pytest.mark.parametrize("walls", GLOTTISES.values(), ids=GLOTTISES)
def test_shapes_of_finite_stretch_walls_and_patches_are_where_damped_motion_comes_to_rest(walls):
    heavy = GlottisTwin(tuple(replace(wall, constants=HEAVY) for wall in walls))
    glottis = product_of(heavy)
    step = time_step_s(Run(), glottis)
    march = TimeMarch(glottis, step, 0.0)
    march.start(0, None)
    advance(march, round(1.0 / step))
    for side, (wall, shape) in enumerate(zip(heavy.walls, static_shapes_of(glottis), strict=True)):
        assert np.abs(membrane(march, "w", side) - shape.w_m).max() < 1e-6 * wall.k.L
        assert np.abs(beam(march, "w_b", side) - shape.w_b).max() < 1e-6 * wall.k.L
        assert np.abs(shape.w_m).max() > 1e-5


@pytest.mark.parametrize("walls", GLOTTISES.values(), ids=GLOTTISES)
def test_every_force_of_finite_stretch_walls_and_patches_balances_at_the_static_shape(walls):
    """Accelerations of the twin, relative to that of a 1 nm displacement of its slowest linear mode."""
    twin = GlottisTwin(walls)
    shapes, rest = static_shapes_of(product_of(twin)), []
    for wall, shape in zip(walls, shapes, strict=True):
        phi = np.diff(shape.w_m, axis=0)[:, 1:-1].T / wall.dy if wall.shear == "rotation" else wall.zero_state().phi
        rest.append(wall.zero_state()._replace(w_m=shape.w_m[:, 1:-1].T, w_b=shape.w_b[1:-1], phi=phi))
    for wall, (a_m, a_b, _) in zip(walls, twin.acceleration(rest, 0.0), strict=True):
        scale = 1e-9 * (2 * np.pi * wall.mode_frequencies(1)[0]) ** 2
        assert np.abs(a_m).max() < scale and np.abs(a_b).max() < scale


def test_the_ends_are_at_rest_and_the_shape_has_its_grid():
    glottis, twin = product_and_twin(**MODAL)
    [shape] = static_shapes_of(glottis)
    assert shape.w_m.shape == shape.medial_m.shape == (10, 20)
    assert not shape.w_m[:, [0, -1]].any() and not shape.w_b[[0, -1]].any()
    assert shape.x_m == pytest.approx(twin.x) and shape.y_m == pytest.approx(twin.y)
    assert shape.medial_m == pytest.approx(twin.medial.T)


def test_the_closure_is_that_of_the_smallest_gap_of_each_slice():
    glottis, _ = product_and_twin(**POSTURES["wide open"])
    [shape] = static_shapes_of(glottis)
    gap = 2 * np.maximum(shape.medial_m - shape.w_m, 0).min(axis=0)
    assert shape.closure.open_area_m2 == pytest.approx(np.trapezoid(gap, shape.x_m), rel=1e-12)
    assert shape.closure.pattern == "open"


def test_the_open_area_of_two_folds_of_different_length_is_that_of_their_mirror_image():
    long = {"posture.strain": 0.2, "posture.glottal_half_angle_rad": 0.1, "activation.ta": 0.1}
    on_left, on_right = (
        prepare(resolve({f"{side}.{path}": value for path, value in long.items()})) for side in ("left", "right")
    )
    first, second = (wall.x_m[-1] for wall in on_left.glottis.walls)
    assert first > 1.1 * second
    assert on_left.static.closure.open_area_m2 == pytest.approx(on_right.static.closure.open_area_m2, rel=1e-9)
