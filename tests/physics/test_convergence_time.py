"""Order in the time step, on a smooth linear problem with every damper: fitted rate and absolute bound."""

import numpy as np
import pytest
from scipy.linalg import eigh

from tests.support.fold_harness import (
    MODAL,
    SHEARS,
    WIDE_OPEN,
    advance,
    get_state,
    half_step_back,
    product_and_twin,
    put_state,
)
from vfcore.fold.form import RECORD
from vfcore.fold.march import TimeMarch
from vfcore.fold.statics import static_shapes_of
from vfcore.spec.simulation import DEFAULT_STEP_S

DAMPED = {"C_coup_pa_s_m": 40.0, "C_foun_pa_s": 5.0, "eta_m_pa_s": 2.0}


def smooth_start(twin):
    """The equilibrium plus 10 µm of each of the eight lowest modes, at rest."""
    system = twin.linear_operators()
    shapes = eigh(system.K, system.M)[1][:, :8]
    displacements = np.abs(shapes[: twin.n * (twin.ny + 1)]).max(axis=0)
    q = np.linalg.solve(system.K, system.load) + (1e-5 * shapes / displacements).sum(axis=1)
    return twin.unpack(q, 0.0 * q)


@pytest.mark.parametrize("shear", SHEARS)
def test_the_step_is_of_second_order_with_dampers(shear):
    glottis, twin = product_and_twin(**WIDE_OPEN, nx=12, ny=6, shear=shear, **DAMPED)
    end = 112 * DEFAULT_STEP_S
    start = smooth_start(twin)
    [exact] = twin.linear_reference(start, [end])
    splits, errors = np.array([2, 4, 8, 16]), []
    for split in splits:
        dt = DEFAULT_STEP_S / split
        march = TimeMarch(glottis, dt, 0.0)
        put_state(march, half_step_back(twin, start, dt))
        advance(march, 112 * split)
        errors.append(np.abs(get_state(march).w_m - exact.w_m).max() / 1e-5)
    order = -np.polyfit(np.log(splits), np.log(errors), 1)[0]
    assert order == pytest.approx(2, abs=0.1)
    assert errors[0] < 2e-4 and errors[-1] < 3e-6


def test_a_voice_through_contact_and_flow_converges_at_first_order():
    """12 ms from the static shape. Contact and separation switch nodes within a step, so the order is at most 1."""
    glottis, _ = product_and_twin(**MODAL)
    [shape] = static_shapes_of(glottis)

    def final(split):
        march = TimeMarch(glottis, DEFAULT_STEP_S / split, 1000.0)
        march.start(0, [shape])
        record = advance(march, 336 * split)
        assert record[:, RECORD.index("contact_pressure_max_pa")].max() > 500
        return get_state(march).w_m

    reference, splits = final(512), np.array([1, 2, 4, 8, 16, 32])
    errors = np.array([np.abs(final(split) - reference).max() for split in splits]) / np.abs(reference).max()
    assert errors[0] < 0.02 and errors[-1] < 4e-4
    assert -np.polyfit(np.log(splits), np.log(errors), 1)[0] > 0.9
