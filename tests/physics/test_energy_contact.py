"""Energy in a bounce: contact conserves energy, but for its damper.

The whole fold moves towards the medial plane, without air. The energy is kinetic plus elastic plus that of
the contact springs, ½ K_col (w − G)² where w > G.
"""

import numpy as np
import pytest

from tests.support.fold_harness import NO_DAMPERS, SHEARS, advance, half_step_back, product_and_twin, put_state
from tests.support.fold_harness import get_state as state_of
from vfcore.fold.march import TimeMarch
from vfcore.spec.simulation import DEFAULT_STEP_S

POSTURE = {"strain": 0.057, "a_ta": 0.4, "theta_g": 0.02, "theta_conv": 0.05}


def thrown(twin):
    """The elastic equilibrium, shifted away from the medial plane and moving towards it at 0.3 m/s."""
    system = twin.linear_operators()
    rest = twin.unpack(np.linalg.solve(system.K, system.load), np.zeros(system.load.size))
    bow = np.sin(np.pi * twin.x[1:-1] / twin.k.L)
    rows = np.linspace(0.7, 1.0, twin.ny)
    w_m = np.minimum(rest.w_m, twin.medial[1:-1]) - 3e-4 * np.outer(bow, rows)
    phi = np.diff(w_m, axis=1) / twin.dy if twin.shear == "rotation" else rest.phi
    return rest._replace(w_m=w_m, w_b=rest.w_b - 3e-4 * bow, phi=phi, v_m=0.3 * np.outer(bow, rows), v_b=0.3 * bow)


def bounce(split, shear, steps=160, **constants):
    """Total energy above the equilibrium and its contact part (steps,), and the kinetic energy at the start, J."""
    glottis, twin = product_and_twin(**POSTURE, nx=12, ny=6, shear=shear, **(NO_DAMPERS | constants))
    system, dt = twin.linear_operators(), DEFAULT_STEP_S / split
    rest, mass = np.linalg.solve(system.K, system.load), np.diag(system.M)
    march, start = TimeMarch(glottis, dt, 0.0), thrown(twin)
    put_state(march, half_step_back(twin, start, dt))
    total, stored, before = [], [], state_of(march)
    for _ in range(steps * split):
        advance(march, 1)
        after = state_of(march)
        (q, v_before), (_, v_after) = twin.pack(before), twin.pack(after)
        overlap = np.maximum(before.w_m - twin.medial[1:-1], 0.0)
        stored.append(twin.constants.K_col_pa_m / 2 * (overlap**2 @ twin.row_width).sum() * twin.dx)
        kinetic = mass @ ((v_before + v_after) / 2) ** 2 / 2
        total.append(kinetic + (q - rest) @ system.K @ (q - rest) / 2 + stored[-1])
        before = after
    v = twin.pack(start)[1]
    return np.array(total), np.array(stored), mass @ v**2 / 2


@pytest.mark.parametrize("shear", SHEARS)
def test_a_bounce_without_dampers_conserves_energy(shear):
    changes = []
    for split in (2, 8, 32):
        total, stored, thrown_in = bounce(split, shear)
        assert stored[0] == stored[-1] == 0 and stored.max() > 0.1 * thrown_in
        changes.append(np.abs(total - total[0]).max() / thrown_in)
    assert changes[0] < 0.02 and changes[-1] < 1e-4
    assert np.polyfit(np.log([2, 8, 32]), np.log(changes), 1)[0] < -1.7


def test_the_contact_damper_only_dissipates():
    total, stored, thrown_in = bounce(32, "kelvin_voigt", C_col_pa_s_m=100.0)
    lost = total[0] - total[-1]
    assert lost > 0.02 * thrown_in
    assert (np.diff(total) < 1e-5 * thrown_in).all()
    apart = np.concatenate([[True], stored[:-1] == 0]) & (stored == 0)
    assert np.abs(np.diff(total)[apart[1:]]).max() < 1e-3 * thrown_in
