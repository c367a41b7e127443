"""Energy without air and contact: conserved without dampers, otherwise lost as the dampers dissipate it."""

import numpy as np
import pytest
from scipy.linalg import eigh

from tests.support.fold_harness import (
    NO_DAMPERS,
    SHEARS,
    WIDE_OPEN,
    advance,
    get_state,
    half_step_back,
    product_and_twin,
    put_state,
)
from vfcore.fold.march import TimeMarch
from vfcore.spec.simulation import DEFAULT_STEP_S


def plucked(twin, count=12, size=1e-5):
    """The equilibrium plus ``size`` of each of the ``count`` lowest modes, at rest."""
    system = twin.linear_operators()
    shapes = eigh(system.K, system.M)[1][:, :count]
    displacements = np.abs(shapes[: twin.n * (twin.ny + 1)]).max(axis=0)
    q = np.linalg.solve(system.K, system.load) + (size * shapes / displacements).sum(axis=1)
    return twin.unpack(q, 0.0 * q)


def states_of(glottis, twin, start, dt, steps):
    """States (q, v) at whole steps: the velocity is the mean of the two adjacent half steps."""
    march = TimeMarch(glottis, dt, 0.0)
    put_state(march, half_step_back(twin, start, dt))
    before = get_state(march)
    for _ in range(steps):
        advance(march, 1)
        after = get_state(march)
        yield before._replace(
            v_m=(before.v_m + after.v_m) / 2, v_b=(before.v_b + after.v_b) / 2, v_phi=(before.v_phi + after.v_phi) / 2
        )
        before = after


def energies(twin, states):
    """Kinetic plus elastic energy above the equilibrium, J, at each state."""
    system = twin.linear_operators()
    rest, mass = np.linalg.solve(system.K, system.load), np.diag(system.M)
    total = []
    for state in states:
        q, v = twin.pack(state)
        total.append((mass @ v**2 + (q - rest) @ system.K @ (q - rest)) / 2)
    return np.array(total)


@pytest.mark.parametrize("shear", SHEARS)
def test_without_dampers_the_energy_oscillates_by_the_square_of_the_step(shear):
    glottis, twin = product_and_twin(**WIDE_OPEN, nx=12, ny=6, shear=shear, **NO_DAMPERS)
    start, drifts = plucked(twin), []
    for split in (1, 2, 4):
        energy = energies(twin, states_of(glottis, twin, start, DEFAULT_STEP_S / split, 200 * split))
        drifts.append(np.abs(energy / energy[0] - 1).max())
    assert drifts[0] < 0.03
    assert np.log2(drifts[0] / drifts[1]) == pytest.approx(2, abs=0.2)
    assert np.log2(drifts[1] / drifts[2]) == pytest.approx(2, abs=0.2)


@pytest.mark.parametrize("shear", SHEARS)
def test_over_thousands_of_steps_energy_only_falls_by_the_cube_of_the_step(shear):
    """Störmer's formula damps a mode by h³/24 per radian, h = ω dt: at most 0.2 % of the energy in 0.14 s."""
    glottis, twin = product_and_twin(**WIDE_OPEN, nx=12, ny=6, shear=shear, **NO_DAMPERS)
    losses = []
    for split in (1, 2):
        states = states_of(glottis, twin, plucked(twin), DEFAULT_STEP_S / split, 4000 * split)
        quarters = energies(twin, states).reshape(4, -1).mean(axis=1)
        assert (np.diff(quarters) < 0).all()
        losses.append(1 - quarters[-1] / quarters[0])
    assert losses[0] < 2e-3
    assert np.log2(losses[0] / losses[1]) == pytest.approx(3, abs=0.3)


@pytest.mark.parametrize("shear", SHEARS)
def test_the_energy_loss_is_the_dissipation_of_the_dampers(shear):
    """E(0) − E(t) = ∫ ẇᵀ C ẇ dt, to second order in the step."""
    glottis, twin = product_and_twin(**WIDE_OPEN, nx=12, ny=6, shear=shear)
    damping, start, misses = twin.linear_operators().C, plucked(twin), []
    for split in (2, 4, 8):
        dt = DEFAULT_STEP_S / split
        states = list(states_of(glottis, twin, start, dt, 200 * split))
        energy = energies(twin, states)
        power = np.array([v @ damping @ v for v in (twin.pack(state)[1] for state in states)])
        lost = energy[0] - energy[-1]
        misses.append(abs(np.trapezoid(power, dx=dt) - lost) / energy[0])
        assert lost > 0.1 * energy[0]
        assert (power >= 0).all() and (np.diff(energy) < 1e-3 * energy[0] / split**2).all()
    assert misses[-1] < 1e-4
    assert np.polyfit(np.log([2, 4, 8]), np.log(misses), 1)[0] < -1.7
