"""The pressure fields on the medial surface are those that drive the step: against the twin, state by state."""

import numpy as np
import pytest

from tests.support.fold_harness import MODAL, product_and_twin, random_state
from vfcore.fold.surface import surface_pressures

P_S = 1000.0


def fields(glottis, w_m, v_m, pressure_pa=P_S):
    """p_aero and p_col (nx, ny) of a twin state (nx, ny)."""
    k = glottis.walls[0].constants
    p_aero, p_col = np.full((2, glottis.ny, glottis.nx), np.nan)
    surface_pressures(
        glottis.walls[0].medial_plane_m - w_m.T,
        np.ascontiguousarray(v_m.T),
        pressure_pa,
        0.0,
        glottis.dy,
        k.alpha_s,
        0.5 * k.rho_a_kg_m3,
        12.0 * k.mu_a_pa_s,
        *glottis.contact,
        p_aero,
        p_col,
    )
    return p_aero.T, p_col.T


@pytest.mark.kernel
@pytest.mark.parametrize("seed", range(4))
def test_fields_of_a_rough_surface_equal_the_twin(seed):
    glottis, twin = product_and_twin(strain=0.057, a_ta=0.4, theta_g=0.02, nx=12, ny=6)
    state = random_state(twin, seed, size=2e-4)
    w_m, v_m = twin.whole(state.w_m), twin.whole(1e3 * state.v_m)
    p_aero, p_col = fields(glottis, w_m, v_m)
    assert np.abs(p_aero - twin.flow(state.w_m, P_S).p_aero).max() < 1e-9 * P_S
    assert np.abs(p_col - twin.contact_pressure(state.w_m, 1e3 * state.v_m)).max() < 1e-9 * np.abs(p_col).max()
    assert 0 < np.count_nonzero(p_col) < p_col.size and np.count_nonzero(p_aero) > 5


@pytest.mark.parametrize("shear", ["kelvin_voigt", "rotation"])
def test_fields_along_a_voice_equal_the_twin(shear):
    glottis, twin = product_and_twin(**MODAL, shear=shear)
    record = twin.run(twin.initial_state(), P_S, 0.0025 / 350 * 4, 700, keep_every=35)
    open_slices = closed_slices = 0
    for state in record.states:
        p_aero, p_col = fields(glottis, twin.whole(state.w_m), twin.whole(state.v_m))
        air = twin.flow(state.w_m, P_S)
        assert np.abs(p_aero - air.p_aero).max() < 1e-9 * P_S
        assert np.abs(p_col - twin.contact_pressure(state.w_m, state.v_m)).max() < 1e-9 * max(1.0, np.abs(p_col).max())
        open_slices += np.count_nonzero(air.d_min > 0)
        closed_slices += np.count_nonzero(air.d_min == 0)
    assert open_slices > 50 and closed_slices > 50
