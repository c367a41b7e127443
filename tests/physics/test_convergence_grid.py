"""Order in the grid spacings: fitted rates and absolute bounds."""

import numpy as np
import pytest

from tests.support.fold_harness import MODAL, NO_DAMPERS, advance, get_state, product_and_twin, put_state
from vfcore.fold.march import TimeMarch
from vfcore.fold.statics import static_shapes_of

GRIDS = [(11, 6), (21, 11), (41, 21)]


@pytest.mark.parametrize(("rows", "along_y"), [("uniform", 0), ("one half-wave over the thickness", 1)])
def test_the_membrane_alone_has_the_frequencies_of_the_continuous_one(rows, along_y):
    """w = sin(πx/L) cos(mπy/b), no coupling: ω² = (T̃ (π/L)² + G̃ (mπ/b)²)/ρ_s, with shear as stiff as tension."""
    frequencies = []
    for nx, ny in GRIDS:
        free = {"K_coup_min_pa_m": 0.0, "K_coup_max_pa_m": 0.0, "G_m_pa": 1e3} | NO_DAMPERS
        glottis, twin = product_and_twin(0.057, 0.4, 0.5, theta_conv=0.3, nx=nx, ny=ny, **free)
        shape = np.outer(np.sin(np.pi * twin.x / twin.k.L), np.cos(along_y * np.pi * twin.y / twin.k.b))[1:-1]
        dt, every = 2e-6, 40
        march = TimeMarch(glottis, dt, 0.0)
        put_state(march, twin.zero_state()._replace(w_m=1e-6 * shape))
        weight = shape * twin.row_width
        coordinate = []
        for _ in range(500):
            coordinate.append((weight * get_state(march).w_m).sum())
            advance(march, every)
        wave = np.array(coordinate)
        falls = np.flatnonzero((wave[:-1] > 0) & (wave[1:] <= 0))
        rises = np.flatnonzero((wave[:-1] < 0) & (wave[1:] >= 0))
        crossing = np.sort([k + wave[k] / (wave[k] - wave[k + 1]) for k in (*falls, *rises)])
        frequencies.append(np.pi / (np.diff(crossing).mean() * dt * every))
    k = twin.k
    exact = np.sqrt((k.T_m_tilde * (np.pi / k.L) ** 2 + k.G_m_tilde * (along_y * np.pi / k.b) ** 2) / k.rho_s)
    errors = np.abs(np.array(frequencies) / exact - 1)
    order = -np.polyfit(np.log([nx - 1 for nx, _ in GRIDS]), np.log(errors), 1)[0]
    assert order == pytest.approx(2, abs=0.1)
    assert errors[-1] < 1e-3


def test_an_open_static_shape_converges_at_second_order_in_both_spacings():
    """Error of the coupled equilibrium at common nodes, against Richardson's limit of the two finest grids."""
    shapes = []
    for refine in (2, 4, 8, 16):
        glottis, _ = product_and_twin(0.057, 0.4, 0.3, theta_conv=0.2, nx=10 * refine + 1, ny=3 * refine + 1)
        static = static_shapes_of(glottis)[0]
        assert (static.w_m < static.medial_m)[:, 1:].all()
        shapes.append(static.w_m[::refine, ::refine])
    limit = shapes[3] + (shapes[3] - shapes[2]) / 3
    errors = np.array([np.abs(shape - limit).max() for shape in shapes[:3]]) / np.abs(limit).max()
    order = -np.polyfit(np.log([2, 4, 8]), np.log(errors), 1)[0]
    assert order == pytest.approx(2, abs=0.25)
    assert errors[-1] < 5e-3


def test_the_closed_modal_static_shape_converges_with_the_grid():
    shapes = []
    for refine in (1, 2, 4):
        glottis, _ = product_and_twin(**MODAL, nx=20 * refine + 1, ny=10 * refine + 1)
        shapes.append(static_shapes_of(glottis)[0].w_m[::refine, ::refine])
    steps = [np.abs(b - a).max() for a, b in zip(shapes[:-1], shapes[1:], strict=True)]
    assert steps[0] < 0.02 * np.abs(shapes[-1]).max()
    assert steps[1] < 0.5 * steps[0]
