"""The compiled equations and their Jacobian against the twin, state by state."""

import numpy as np
import pytest

from tests.support import posture_twin as twin
from vfcore.kernels.posture_equations import equilibrium
from vfcore.larynx.posture.packing import MUSCLE_ORDER, load_scale, pack
from vfcore.spec.posture_sets import POSTURE_SETS, posture_set

SPREAD = np.array([3e-3, 3e-3, 0.3, 0.08, 0.2])  # every stiffness law exceeds its limit; a third of the states collide


def states(n, seed):
    generator = np.random.default_rng(seed)
    return generator.normal(size=(n, 5)) * SPREAD, generator.random((n, 5))


def evaluate(constants, unknowns, activation, passive=1.0):
    muscles, joints = pack(constants)
    r, jac = np.full(5, np.nan), np.full((5, 5), np.nan)
    xi_02, strain = equilibrium(unknowns, activation, passive, muscles, joints, r, jac)
    return xi_02, strain, r, jac, load_scale(muscles, joints)


@pytest.mark.parametrize("name", POSTURE_SETS)
def test_residuals_equal_the_naive_equations(name):
    c = posture_set(name)
    collisions = 0
    for u, a in zip(*states(300, 1), strict=True):
        xi_02, strain, r, _, scale = evaluate(c, u, a)
        expected = twin.residual(c, u, dict(zip(MUSCLE_ORDER, a, strict=True)))
        assert np.max(np.abs(r - expected) / np.maximum(scale, np.abs(expected))) < 1e-12
        assert xi_02 == pytest.approx(twin.vocal_process_x(c, u[0], u[2]), abs=1e-15)
        assert strain == pytest.approx(twin.strains(c, u)["ta"], abs=1e-14)
        collisions += xi_02 < 0
    assert 20 < collisions < 280, "the sample must have states with and without collision"


@pytest.mark.parametrize("name", POSTURE_SETS)
def test_jacobian_equals_central_differences_of_the_naive_equations(name):
    c = posture_set(name)
    step = 1e-7 * twin.UNKNOWN_SCALE
    for u, a in zip(*states(40, 2), strict=True):
        activation = dict(zip(MUSCLE_ORDER, a, strict=True))
        _, _, _, jac, _ = evaluate(c, u, a)
        for k in range(5):
            shift = np.where(np.arange(5) == k, step, 0.0)
            column = (twin.residual(c, u + shift, activation) - twin.residual(c, u - shift, activation)) / (2 * step[k])
            assert jac[:, k] == pytest.approx(column, rel=1e-5, abs=1e-6 * np.abs(jac).max(axis=1).max())


def test_collision_starts_without_a_jump_and_pushes_the_process_back():
    c = posture_set("serry2026")
    theta = 0.1
    touching = -twin.vocal_process_x(c, 0.0, theta)
    relaxed = np.zeros(5)

    def loads(depth):
        return evaluate(c, np.array([touching - depth, 0.0, theta, 0.0, 0.0]), relaxed)[2]

    assert loads(1e-9) == pytest.approx(loads(-1e-9), abs=1e-5)
    free = 60 * 2e-4 * 1.2 * 2  # more than the lateral spring changes over 0.2 mm
    assert loads(2e-4)[0] - loads(0.0)[0] > free
    assert loads(2e-4)[2] < loads(0.0)[2], "the collision turns the process outward"


@pytest.mark.parametrize("xi", [-0.03, -0.0219, 0.0017, 0.0018, 0.01])
def test_states_where_no_collision_angle_exists_stay_finite(xi):
    c = posture_set("serry2026")
    for theta in (-3.0, -1.0, 0.0, 1.0274, 3.0):
        xi_02, _, r, jac, _ = evaluate(c, np.array([xi, 0.0, theta, 0.0, 0.0]), np.zeros(5))
        assert np.isfinite(r).all()
        assert np.isfinite(jac).all()
        if xi > 0.00171:
            assert xi_02 > 0, "joint centres further apart than the process is long: no contact at any rotation"


def test_passive_stress_is_zero_below_its_strain_of_zero_stress():
    c = posture_set("serry2026")
    u = np.array([0.0, 0.0, 0.0, -0.2, -0.4])  # fold strain -0.6; CT is stretched
    _, strain, r, _, _ = evaluate(c, u, np.zeros(5))
    assert strain == pytest.approx(-0.6)
    _, _, r_without_passive, _, _ = evaluate(c, u, np.zeros(5), passive=0.0)
    ct = r[3] - r_without_passive[3]
    assert (r - r_without_passive)[4] == pytest.approx(c.w_CT_m / c.cos_phi * ct), "only CT pulls, the fold is slack"
