"""Störmer's displacement on one mode: its frequency error, and its loss without a damper."""

import numpy as np
import pytest

from vfcore.fold.displacement import displaced

pytestmark = pytest.mark.kernel


def mode(h: float) -> complex:
    """Complex growth factor of a mode of 1 rad/s per step of ``h``, an eigenvalue of the linear map of the step."""

    def step(w, v, v_star):
        dv = -h * w
        return displaced(w, v, v_star, h, -w, h), v + dv, v + 1.5 * dv

    roots = np.linalg.eigvals(np.array([step(*start) for start in np.eye(3)]).T)
    return roots[roots.imag.argmax()]


@pytest.mark.parametrize("h", [0.02, 0.05, 0.1])
def test_the_frequency_error_is_of_fourth_order(h):
    assert np.angle(mode(h)) / h - 1 == pytest.approx(0.0229 * h**4, rel=0.02)


@pytest.mark.parametrize("h", [0.02, 0.05, 0.1])
def test_an_undamped_mode_loses_a_twenty_fourth_of_the_cube_per_radian(h):
    assert -np.log(np.abs(mode(h))) / h == pytest.approx(h**3 / 24, rel=0.01)


def test_without_force_the_velocity_is_constant():
    assert displaced(0.5, 2.0, 2.0, 0.1, 0.0, 0.1) == pytest.approx(0.7, rel=1e-15)
