"""Roots of the posturing equations: found everywhere, unique, continuous, or refused with a reason."""

import os

import numpy as np
import pytest
from scipy.optimize import root

from tests.support import posture_twin as twin
from vfcore.errors import PostureError
from vfcore.larynx.posture.equilibrium import solve_posture, solve_posture_batch
from vfcore.larynx.posture.packing import MUSCLE_ORDER, load_scale, pack
from vfcore.spec.posture_sets import POSTURE_SETS, posture_set
from vfcore.spec.simulation import Activation

UNCOMPILED = os.environ.get("NUMBA_DISABLE_JIT") == "1"  # the same tests in plain Python, on fewer points
SAMPLES = 40 if UNCOMPILED else 10_000
SEGMENTS = 1 if UNCOMPILED else 200


def named(activation):
    return dict(zip(MUSCLE_ORDER, activation, strict=True))


@pytest.mark.parametrize("name", POSTURE_SETS)
def test_every_random_activation_has_a_root_of_the_naive_equations(name):
    c = posture_set(name)
    generator = np.random.default_rng(2026)
    activations = generator.random((SAMPLES, 5))
    activations[::10] = np.round(activations[::10])  # corners of the cube, where the loads are extreme
    batch = solve_posture_batch(activations, c)
    assert batch.converged.all()
    assert (batch.reached == 1).all()
    scale = load_scale(*pack(c))
    for u, a, reported in zip(batch.unknowns, activations, batch.residual, strict=True):
        worst = np.max(np.abs(twin.residual(c, u, named(a))) / scale)
        assert worst < 1e-9
        assert reported == pytest.approx(worst, abs=1e-12)
    assert (np.abs(batch.strain) < 0.6).all()
    assert (batch.raw_glottal_half_angle_rad > -0.05).all(), "the collision holds the processes apart"


@pytest.mark.parametrize("name", POSTURE_SETS)
def test_root_equals_the_twin_continued_in_small_steps(name):
    c = posture_set(name)
    activations = np.random.default_rng(7).random((12, 5))
    activations[:4, :2] = [[1, 1], [0.9, 1], [1, 0.9], [0.95, 0.95]]  # high CT with high TA: slack in both
    batch = solve_posture_batch(activations, c)
    for a, u, strain, angle in zip(
        activations, batch.unknowns, batch.strain, batch.raw_glottal_half_angle_rad, strict=True
    ):
        expected = twin.solve(c, named(a), steps=15)
        assert u / twin.UNKNOWN_SCALE == pytest.approx(expected / twin.UNKNOWN_SCALE, abs=1e-9)
        assert (strain, angle) == pytest.approx(twin.strain_and_half_angle(c, expected), abs=1e-10)


@pytest.mark.parametrize("name", POSTURE_SETS)
def test_other_starting_points_lead_to_the_same_root_or_to_none(name):
    """A general root finder often stalls far from the root; where its residual is small, it agrees."""
    c = posture_set(name)
    scale = load_scale(*pack(c))
    generator = np.random.default_rng(11)
    reached = 0
    for a in ([1, 1, 0, 0, 0], [1, 1, 0.6, 0.6, 0], [1, 1, 1, 1, 1]):
        u = solve_posture_batch([a], c).unknowns[0]
        for z in generator.uniform(-1, 1, (25, 5)) * [5, 5, 7, 3, 6]:
            load = named(a)
            with np.errstate(all="ignore"):  # bad trial steps overflow the exponentials
                found = root(lambda z, load=load: twin.residual(c, z * twin.UNKNOWN_SCALE, load) / scale, z)
            if np.max(np.abs(found.fun)) < 1e-9:
                reached += 1
                assert found.x == pytest.approx(u / twin.UNKNOWN_SCALE, abs=1e-5)
    assert reached >= 5


@pytest.mark.parametrize("name", POSTURE_SETS)
def test_the_posture_is_continuous_along_segments(name):
    """Under refinement the height of a jump stays; that of a steep slope falls."""
    c = posture_set(name)
    generator = np.random.default_rng(5)
    t = np.linspace(0, 1, 200)[:, None]
    jumps = []
    for start, end in generator.random((SEGMENTS, 2, 5)):
        line = start + t * (end - start)
        batch = solve_posture_batch(line, c)
        assert batch.converged.all()
        move = np.abs(np.diff(np.column_stack([batch.strain, batch.raw_glottal_half_angle_rad]), axis=0)).max(axis=1)
        assert move.max() < 10 * np.linalg.norm(end - start) / 199, "no published set changes faster than that"
        k = int(move.argmax())
        jumps.append((move[k], line[k], line[k + 1]))
    for height, a, b in sorted(jumps, key=lambda jump: -jump[0])[: SEGMENTS // 10 + 1]:
        fine = solve_posture_batch(a + np.linspace(0, 1, 65)[:, None] * (b - a), c)
        steps = np.diff(np.column_stack([fine.strain, fine.raw_glottal_half_angle_rad]), axis=0)
        assert np.abs(steps).max() < height / 16


def test_the_result_does_not_depend_on_earlier_requests():
    c = posture_set("palaparthi2019")
    activations = np.random.default_rng(3).random((60, 5))
    together = solve_posture_batch(activations, c).unknowns
    backwards = solve_posture_batch(activations[::-1], c).unknowns[::-1]
    alone = np.vstack([solve_posture_batch(row[None], c).unknowns for row in activations])
    assert (together == backwards).all()
    assert (together == alone).all()


def fold_ahead():
    """A fold so stiff that full CT with full IA has no equilibrium connected to rest."""
    return posture_set("serry2026").override("TA_exponential_B", 40)


def test_a_folding_path_is_refused_with_its_position():
    with pytest.raises(PostureError) as caught:
        solve_posture(Activation(ta=0, ct=1, lca=0, ia=1, pca=0), fold_ahead())
    sentence = str(caught.value)
    for part in ("CT 1", "IA 1", "serry2026 with overridden constants", "92.3", "Lower the activation"):
        assert part in sentence


def test_a_folding_path_ends_at_a_turning_point():
    """Near a turning point the distance in u is the root of that in load: the path ends there, no root was missed."""
    constants, direction = fold_ahead(), np.array([0.0, 1, 0, 1, 0])
    full = solve_posture_batch([direction], constants)
    assert not full.converged[0]
    assert np.isnan(full.strain[0])
    assert np.isnan(full.unknowns).all()
    loads = full.reached[0] - np.array([0, 1e-6, 4e-6])
    theta = solve_posture_batch(loads[:, None] * direction, constants).unknowns[:, 2]
    assert (theta[0] - theta[2]) / (theta[0] - theta[1]) == pytest.approx(2.0, rel=0.05)


def test_joint_too_weak_to_rest_is_refused():
    weak = posture_set("palaparthi2019").override("kappa_n_m_rad", 1e-5)
    with pytest.raises(PostureError, match="relaxed larynx has no equilibrium"):
        solve_posture(Activation(), weak)


def test_fold_shortened_to_nothing_is_refused():
    soft = {"k_t_n_m": 1, "k_t_quadratic_m2": 0, "k_t_quartic_m4": 0, "k_t_rotation_rad": 0}
    soft |= {"k_r_n_m_rad": 1e-4, "k_r_quadratic_rad2": 0, "k_r_quartic_rad4": 0, "k_r_translation_m": 0}
    everlasting = soft | {"TA_sigma_max_active_pa": 1e6, "TA_active_width_b": 0}
    with pytest.raises(PostureError, match="less than nothing"):
        solve_posture(Activation(ta=1, ct=0, lca=0, ia=0, pca=0), posture_set("serry2026").override_all(everlasting))
