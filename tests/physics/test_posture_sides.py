"""The posture of a larynx with two different sides: its equations, its roots, and what a clinician would see."""

import math
import os
from dataclasses import astuple, replace

import numpy as np
import pytest

from tests.support import posture_twin as twin
from vfcore.errors import ParameterError, PostureError
from vfcore.kernels.posture_sides import equilibrium_of_sides
from vfcore.larynx.posture.equilibrium import COMMON_CONSTANTS, solve_each_sides, solve_posture, solve_sides
from vfcore.larynx.posture.packing import MUSCLE_ORDER, load_scale, load_scale_of_sides, pack
from vfcore.spec.posture_sets import POSTURE_SETS, posture_set
from vfcore.spec.simulation import Activation

UNCOMPILED = os.environ.get("NUMBA_DISABLE_JIT") == "1"  # the same tests in plain Python, on fewer points
PAIRS = 20 if UNCOMPILED else 2000
STEADY = [name for name in POSTURE_SETS if name != "palaparthi2019"]  # there a slight difference may move the plane far
SCALE = np.concatenate([twin.UNKNOWN_SCALE[:3], twin.UNKNOWN_SCALE[:3], twin.UNKNOWN_SCALE[3:]])
SPREAD = np.array([3e-3, 3e-3, 0.3, 3e-3, 3e-3, 0.3, 0.08, 0.2])
MEDIAL = np.array([2.5e-3, 0, 0, 2.5e-3, 0, 0, 0, 0])  # so that about half of the states touch
#: One side with other muscles, another cricoarytenoid joint and a softer collision.
OTHER = {
    "TA_sigma_max_active_pa": 7e4, "IA_alpha": -0.6, "CT_cross_section_m2": 6e-5, "muc_exponential_B": 7.0,
    "x_CAJ_m": 0.0096, "y_CAJ_m": -0.0105, "vocal_process_x_m": 0.0043, "k_x_n_m": 75.0, "kappa_n_m_rad": 0.006,
    "collision_ratio": 12.0,
}  # fmt: skip
MODAL = Activation()
PARALYSED = Activation(ta=0, lca=0, ia=0, pca=0)  # the recurrent nerve is silent; CT .3 as in the modal posture


def named(row):
    return dict(zip(MUSCLE_ORDER, map(float, row), strict=True))


def of(row):
    return Activation(**named(row))


def random_pairs(n, seed):
    """Activations (n, 2, 5); every third pair adducts strongly, so that many processes touch; some are corners."""
    rows = np.random.default_rng(seed).random((n, 2, 5))
    rows[::3, :, 2] = 0.7 + 0.3 * rows[::3, :, 2]
    rows[::3, :, 4] *= 0.2
    rows[::10] = np.round(rows[::10])
    return rows


def unknowns(left, right):
    return np.array(
        [
            left.xi_m, left.psi_m, left.theta_a_rad, right.xi_m, right.psi_m, right.theta_a_rad,
            left.epsilon_t, left.epsilon_r,
        ]
    )  # fmt: skip


def postures(found):
    """The pair of postures, which must not be an error."""
    assert not isinstance(found, PostureError), str(found)
    return found


def plane_of(side):
    """Distance of the plane of contact towards this side, m; the processes must touch."""
    assert side.contact_plane_m is not None
    return side.contact_plane_m


def both_kinds_of_larynx(name):
    """A set on both sides, and with the other side as in ``OTHER``."""
    c = posture_set(name)
    return [(c, c), (c, c.override_all(OTHER)), (c.override_all(OTHER), c)]


def evaluate(left, right, u, activations):
    """Outputs of the compiled equations: ξ_02 and ε̄ of each side and the plane; r (9,), J (8, 8), scale (9,)."""
    (muscles_l, joints_l), (muscles_r, joints_r) = pack(left), pack(right)
    free_l, free_r = (joints._replace(collision_ratio=0.0) for joints in (joints_l, joints_r))
    r, jac = np.full(9, np.nan), np.full((8, 8), np.nan)
    larynx = (muscles_l, joints_l, free_l, muscles_r, joints_r, free_r, np.full((2, 7, 5), np.nan))
    found = equilibrium_of_sides(u, activations.ravel(), 1.0, larynx, r, jac)
    return found, r, jac, load_scale_of_sides(load_scale(muscles_l, joints_l), load_scale(muscles_r, joints_r))


def naive(left, right, u, activations):
    """The eight equations of the twin with its own plane of contact. IA is the same on both sides."""
    plane = twin.plane_of_contact(left, right, u)
    return twin.residual_of_sides(left, right, u, named(activations[0]), named(activations[1]), plane)


def states(n, seed):
    generator = np.random.default_rng(seed)
    activations = generator.random((n, 2, 5))
    activations[:, 1, 3] = activations[:, 0, 3]
    return generator.normal(size=(n, 8)) * SPREAD - MEDIAL, activations


@pytest.mark.parametrize("name", POSTURE_SETS)
def test_residuals_equal_the_naive_equations(name):
    touching = 0
    for left, right in both_kinds_of_larynx(name):
        for u, a in zip(*states(100, 1), strict=True):
            (xi_l, strain_l, xi_r, strain_r, plane), r, _, scale = evaluate(left, right, u, a)
            expected = naive(left, right, u, a)
            assert np.max(np.abs(r[:8] - expected) / np.maximum(scale[:8], np.abs(expected))) < 1e-11
            assert abs(r[8]) < 1e-11 * scale[8] * max(1, np.abs(expected / scale[:8]).max())
            assert (xi_l, xi_r) == pytest.approx(twin.process_positions(left, right, u), abs=1e-15)
            strains = [twin.strains(c, own)["ta"] for c, own in zip((left, right), twin.arytenoids(u), strict=True)]
            assert (strain_l, strain_r) == pytest.approx(strains, abs=1e-14)
            assert plane == pytest.approx(twin.plane_of_contact(left, right, u), abs=1e-13)
            touching += xi_l + xi_r < 0
    assert 30 < touching < 270, "the sample must have states with and without contact"


@pytest.mark.parametrize("name", POSTURE_SETS)
def test_jacobian_equals_central_differences_of_the_naive_equations(name):
    """In contact the plane moves with the state; its motion is part of the derivative."""
    step, touching = 1e-7 * SCALE, 0
    for left, right in both_kinds_of_larynx(name):
        for u, a in zip(*states(20, 2), strict=True):
            found, _, jac, _ = evaluate(left, right, u, a)
            touching += found[0] + found[2] < 0
            for k in range(8):
                shift = np.where(np.arange(8) == k, step, 0.0)
                column = (naive(left, right, u + shift, a) - naive(left, right, u - shift, a)) / (2 * step[k])
                assert jac[:, k] == pytest.approx(column, rel=1e-5, abs=1e-6 * np.abs(jac).max(axis=1).max())
    assert touching > 10


@pytest.mark.parametrize("name", POSTURE_SETS)
def test_equal_sides_have_the_posture_of_one_side(name):
    c = posture_set(name)
    for row in random_pairs(PAIRS * 3 // 20, 3)[:, 0]:
        one = solve_posture(of(row), c)
        for side in solve_sides(of(row), of(row), c, c):
            assert astuple(side)[:-1] == pytest.approx(astuple(one)[:-1], abs=1e-15)
            assert side.contact_plane_m == (0 if one.raw_glottal_half_angle_rad <= 0 else None)


@pytest.mark.parametrize("name", STEADY)
def test_a_difference_that_vanishes_leaves_the_posture_of_one_side(name):
    """So the equations of two sides give the answer of one, and the posture is continuous where the sides are equal."""
    c = posture_set(name)
    touching = 0
    for row in random_pairs(PAIRS * 3 // 20, 4)[:, 0]:
        row[0] = min(row[0], 0.9)
        almost = row + [1e-12, 0, 0, 0, 0]
        one, pair = solve_posture(of(row), c), solve_sides(of(row), of(almost), c, c)
        for side in pair:
            assert astuple(side)[:-2] == pytest.approx(astuple(one)[:-2], abs=2e-11)
        touching += pair[0].contact_plane_m is not None
    assert touching >= 1


@pytest.mark.parametrize("name", POSTURE_SETS)
def test_mirrored_sides_have_mirrored_postures(name):
    touching = 0
    for left, right in both_kinds_of_larynx(name):
        for a, b in random_pairs(PAIRS // 20, 5):
            here = solve_sides(of(a), of(b), left, right, 0.015, 0.016)
            there = solve_sides(of(b), of(a), right, left, 0.016, 0.015)
            for one, other in zip(here, reversed(there), strict=True):
                assert astuple(one)[:-2] == pytest.approx(astuple(other)[:-2], abs=1e-11)
                assert (one.contact_plane_m is None) == (other.contact_plane_m is None)
                if one.contact_plane_m is not None:
                    assert one.contact_plane_m == pytest.approx(other.contact_plane_m, abs=1e-12)
                    touching += 1
    assert touching >= 2


@pytest.mark.parametrize("name", POSTURE_SETS)
def test_every_random_pair_has_a_root_of_the_naive_equations(name):
    left = right = posture_set(name)
    scale = load_scale(*pack(left))
    rows = random_pairs(PAIRS, 6)
    touching = 0
    for (a, b), found in zip(rows, solve_each_sides([(of(a), of(b)) for a, b in rows], left, right), strict=True):
        assert not isinstance(found, PostureError), str(found)
        u = unknowns(*found)
        plane = twin.plane_of_contact(left, right, u)
        r = twin.residual_of_sides(left, right, u, named(a), named(b), plane)
        assert np.max(np.abs(r) / np.concatenate([scale[:3], scale[:3], scale[3:]])) < 1e-11
        contact = found[0].contact_plane_m is not None
        assert contact == (sum(twin.process_positions(left, right, u)) <= 0)
        if contact:
            assert (found[0].contact_plane_m, found[1].contact_plane_m) == pytest.approx((plane, -plane), abs=1e-13)
            forces = twin.contact_forces(left, right, u, found[0].contact_plane_m)
            assert min(forces) > 0, "each process is pushed back to its side"
            assert forces[0] == pytest.approx(forces[1], abs=1e-11 * scale[0])
            touching += 1
        assert found[0].residual == found[1].residual <= 1e-12
        assert sum(twin.process_positions(left, right, u)) > -1.2e-3, "the collision holds the processes apart"
    assert touching > PAIRS / 100


@pytest.mark.parametrize("name", STEADY)
def test_root_equals_that_of_a_general_solver_without_continuation(name):
    touching = 0
    for left, right in both_kinds_of_larynx(name):
        for a, b in random_pairs(5 if UNCOMPILED else 17, 7):
            found = solve_sides(of(a), of(b), left, right)
            expected = twin.solve_sides(left, right, named(a), named(b))
            assert expected is not None
            assert unknowns(*found) / SCALE == pytest.approx(expected[0] / SCALE, abs=1e-9)
            if found[0].contact_plane_m is not None:
                assert found[0].contact_plane_m == pytest.approx(expected[1], abs=1e-12)
                touching += 1
    assert touching >= 1


def test_where_the_processes_touch_the_angles_close_the_glottis_between_them():
    c = posture_set("serry2026")
    left, right = solve_sides(MODAL, replace(MODAL, ta=0.2, lca=0.75), c, c)
    assert left.contact_plane_m is not None
    raw = [math.tan(side.raw_glottal_half_angle_rad) * (1 + side.strain) * c.L_0_posture_m for side in (left, right)]
    gaps = [math.tan(side.glottal_half_angle_rad) * (1 + side.strain) * c.L_0_posture_m for side in (left, right)]
    assert sum(raw) < 0
    assert gaps == pytest.approx([(raw[0] - raw[1]) / 2, (raw[1] - raw[0]) / 2], abs=1e-15)
    assert gaps == pytest.approx([left.half_gap_m, right.half_gap_m], abs=1e-15)
    assert gaps[0] + gaps[1] == pytest.approx(0, abs=1e-18)
    assert min(gaps) < -1e-4, "one side crosses the midline"
    assert left.contact_plane_m == pytest.approx(left.half_gap_m, abs=abs(sum(raw)) / 2)


def test_where_they_do_not_touch_the_angles_are_the_raw_ones():
    c = posture_set("serry2026")
    for side in solve_sides(MODAL, PARALYSED, c, c):
        assert side.contact_plane_m is None
        assert side.glottal_half_angle_rad == side.raw_glottal_half_angle_rad
        assert math.tan(side.glottal_half_angle_rad) * (1 + side.strain) * c.L_0_posture_m == pytest.approx(
            side.half_gap_m, abs=1e-15
        )


def test_each_side_has_the_length_of_its_own_fold():
    c = posture_set("serry2026")
    left, right = solve_sides(MODAL, PARALYSED, c, c, 0.015, 0.010)
    assert left.length_m == pytest.approx(0.015 * (1 + left.strain), abs=1e-15)
    assert right.length_m == pytest.approx(0.010 * (1 + right.strain), abs=1e-15)


@pytest.mark.parametrize("name", POSTURE_SETS)
def test_a_healthy_side_crosses_the_midline_towards_a_paralysed_one(name):
    """The paralysed process lies 2 to 5 mm from the midline; the healthy one has nothing to meet there, and crosses."""
    c = posture_set(name)
    healthy, paralysed = solve_sides(replace(MODAL, lca=1, ia=1), PARALYSED, c, c)
    assert -3e-3 < healthy.half_gap_m < -0.5e-3
    assert 2e-3 < paralysed.half_gap_m < 5e-3
    assert paralysed.epsilon_r == healthy.epsilon_r
    mirrored = solve_posture(replace(MODAL, lca=1, ia=0.5), c)
    assert healthy.half_gap_m < mirrored.half_gap_m + 1e-12, "no partner holds it back"


def test_the_stronger_side_pushes_the_plane_to_the_weaker_side():
    c = posture_set("serry2026")
    planes = []
    for weak in (0.8, 0.78, 0.76, 0.74):
        left, right = solve_sides(MODAL, replace(MODAL, lca=weak), c, c)
        planes.append(plane_of(right))
        assert plane_of(left) == -plane_of(right)
    assert planes[0] == 0
    assert (np.diff(planes) > 1e-5).all()


def test_a_softer_collision_moves_the_plane_to_its_side():
    """The same force needs a deeper contact on the softer side, which therefore gives way further."""
    c = posture_set("serry2026")
    left, right = solve_sides(MODAL, MODAL, c, c.override("collision_ratio", 5.0))
    overlap = [plane_of(side) - math.tan(side.raw_glottal_half_angle_rad) * (1 + side.strain) * c.L_0_posture_m
               for side in (left, right)]  # fmt: skip
    assert overlap[1] > 2 * overlap[0] > 0


def test_ia_is_one_muscle_with_two_nerves():
    c = posture_set("serry2026")
    apart = solve_sides(replace(MODAL, ia=1.0), replace(MODAL, ta=0.1, ia=0.5), c, c)
    mean = solve_sides(replace(MODAL, ia=0.75), replace(MODAL, ta=0.1, ia=0.75), c, c)
    assert apart == mean
    strong, weak = solve_sides(MODAL, MODAL, c, c.override("IA_cross_section_m2", 6e-6))
    assert weak.xi_m > strong.xi_m + 2e-4, "each side has its own IA constants, and IA draws the arytenoid medially"


@pytest.mark.parametrize("name", POSTURE_SETS)
def test_both_ct_act_on_the_one_joint(name):
    """A silent superior laryngeal nerve changes the posture of both sides alike."""
    c = posture_set(name)
    one_nerve = solve_sides(replace(MODAL, ct=0.6), replace(MODAL, ct=0.0), c, c)
    mean = solve_posture(replace(MODAL, ct=0.3), c)
    for side in one_nerve:
        assert astuple(side)[:-1] == pytest.approx(astuple(mean)[:-1], abs=1e-15)
    unequal = solve_sides(replace(MODAL, ct=0.6, ta=0.5), replace(MODAL, ct=0.0), c, c)
    swapped = solve_sides(replace(MODAL, ct=0.0, ta=0.5), replace(MODAL, ct=0.6), c, c)
    for one, other in zip(unequal, swapped, strict=True):
        assert one.strain == pytest.approx(other.strain, abs=1e-11)


def test_the_posture_is_continuous_where_contact_is_gained_and_lost():
    c = posture_set("serry2026")
    weakening = np.linspace(0, 0.3, 400)
    pairs = [(MODAL, replace(MODAL, lca=0.8 - s, pca=s / 3)) for s in weakening]
    found = [postures(pair) for pair in solve_each_sides(pairs, c, c)]
    contact = np.array([left.contact_plane_m is not None for left, _ in found])
    assert contact[0]
    assert not contact[-1]
    assert np.count_nonzero(np.diff(contact)) == 1
    path = np.array([[(side.strain, side.glottal_half_angle_rad, side.raw_glottal_half_angle_rad) for side in pair]
                     for pair in found])  # fmt: skip
    assert np.abs(np.diff(path, axis=0)).max() < 2.5e-3, "over a step of .00075 in LCA"


@pytest.mark.parametrize("name", STEADY)
def test_contact_at_rest_may_be_lost_on_the_way(name):
    """Processes that touch at rest, pulled apart by both PCA: the path to the posture runs through contact."""
    touching_at_rest = {"x_CAJ_m": 0.0095, "vocal_process_x_m": 0.0, "PCA_sigma_0_pa": 0, "PCA_sigma_2_pa": 0}
    c = posture_set(name).override_all(touching_at_rest)
    relaxed = of(np.zeros(5))
    assert solve_sides(relaxed, replace(relaxed, lca=0.001), c, c)[0].contact_plane_m is not None
    rows = np.random.default_rng(8).random((3 if UNCOMPILED else 12, 2, 5))
    for a, b in rows * [0.3, 1, 0.2, 0.3, 0.6] + [0, 0, 0, 0, 0.4]:
        found = solve_sides(of(a), of(b), c, c)
        assert found[0].contact_plane_m is None
        expected, _ = twin.solve_sides(c, c, named(a), named(b))
        assert unknowns(*found) / SCALE == pytest.approx(expected / SCALE, abs=1e-9)


@pytest.mark.parametrize("name", COMMON_CONSTANTS)
def test_the_cricothyroid_joint_has_one_set_of_constants(name):
    c = posture_set("serry2026")
    with pytest.raises(ParameterError) as caught:
        solve_sides(MODAL, MODAL, c, c.override(name, 0.99 * c.value(name)))
    assert caught.value.path == f"right.constants.{name}"
    assert "both sides" in str(caught.value)


@pytest.mark.parametrize("side", ["left", "right"])
def test_a_length_out_of_range_is_refused_by_its_name(side):
    c = posture_set("serry2026")
    with pytest.raises(ParameterError) as caught:
        solve_sides(MODAL, MODAL, c, c, **{f"{side}_length_m": 0.2})
    assert caught.value.path == f"{side}_length_m"


@pytest.mark.parametrize("side", ["left", "right"])
def test_a_side_without_a_posture_is_named(side):
    c = posture_set("serry2026")
    stiff = c.override("TA_exponential_B", 40)
    strong = Activation(ta=0, ct=1, lca=0, ia=1, pca=0)
    constants = (stiff, c) if side == "left" else (c, stiff)
    with pytest.raises(PostureError, match=f"The {side} side is to blame"):
        solve_sides(strong, strong, *constants)
    with pytest.raises(PostureError) as caught:
        solve_sides(strong, strong, stiff, stiff)
    assert "to blame" not in str(caught.value)


def test_many_pairs_are_solved_as_each_by_itself():
    c, other = posture_set("serry2026"), posture_set("serry2026").override_all(OTHER)
    pairs = [(of(a), of(b)) for a, b in random_pairs(40, 9)]
    pairs[7] = (MODAL, MODAL)
    assert solve_each_sides(pairs, c, other) == [solve_sides(*pair, c, other) for pair in pairs]
    assert solve_each_sides(pairs, c, c) == [solve_sides(*pair, c, c) for pair in pairs]
    assert solve_each_sides([], c, c) == []


def test_a_pair_without_posture_does_not_spoil_the_others():
    stiff = posture_set("serry2026").override("TA_exponential_B", 40)
    strong = Activation(ta=0, ct=1, lca=0, ia=1, pca=0)
    found = solve_each_sides([(MODAL, PARALYSED), (strong, strong), (strong, replace(strong, ta=0.1))], stiff, stiff)
    assert found[0] == solve_sides(MODAL, PARALYSED, stiff, stiff)
    assert isinstance(found[1], PostureError)
    assert "left TA 0, CT 1" in str(found[1])
