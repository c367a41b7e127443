"""Two walls that may differ: equal ones are the mirrored fold, contact and air of a pair, entrainment."""

from dataclasses import replace

import numpy as np
import pytest

from tests.support.fold_twin import FoldTwin
from tests.support.glottis_twin import GlottisTwin
from tests.support.patched_twin import patched
from tests.support.wall_twin import WallTwin
from vfcore.fold.constants import FoldConstants
from vfcore.spec.simulation import DEFAULT_STEP_S

MODAL = WallTwin(0.057, 0.4, 0.0)
SLACK = WallTwin(0.057, 0.0, 0.1)


def moved_to(wall, w_m, v_m=0.0):
    """A state with the membrane everywhere at ``w_m``, m, and at the speed ``v_m``, m/s."""
    state = wall.zero_state()
    return state._replace(w_m=state.w_m + w_m, v_m=state.v_m + v_m)


@pytest.mark.parametrize(
    "wall",
    [MODAL, replace(MODAL, stretch="finite"), replace(MODAL, shear="rotation"), patched(MODAL, bump_m=2e-4)],
    ids=["linear", "finite", "rotation", "patch"],
)
def test_two_equal_walls_are_the_mirrored_fold(wall):
    one, two = GlottisTwin((wall,)), GlottisTwin((wall, wall))
    a = one.march(one.initial_states(), 1000.0, DEFAULT_STEP_S, 700)
    b = two.march(two.initial_states(), 1000.0, DEFAULT_STEP_S, 700)
    assert a.p_col_max.max() > 100 and a.Q_g.max() > 1e-4
    for mirrored, left, right in zip(a.final[0], *b.final, strict=True):
        assert (left == right).all()
        assert np.abs(left - mirrored).max() < 1e-9 * max(1e-6, np.abs(mirrored).max())
    assert np.abs(b.Q_g - a.Q_g).max() < 1e-9 * a.Q_g.max()
    assert np.abs(b.p_col_max - a.p_col_max).max() < 1e-9 * a.p_col_max.max()


def test_exchanging_left_and_right_exchanges_their_motion():
    longer = replace(SLACK, strain=0.15)
    ahead, exchanged = GlottisTwin((MODAL, longer)), GlottisTwin((longer, MODAL))
    a = ahead.march(ahead.initial_states(), 1000.0, DEFAULT_STEP_S, 700)
    b = exchanged.march(exchanged.initial_states(), 1000.0, DEFAULT_STEP_S, 700)
    for state, other in zip(a.final, reversed(b.final), strict=True):
        assert np.abs(state.w_m - other.w_m).max() < 1e-12
    assert np.abs(a.final[0].w_m - a.final[1].w_m).max() > 1e-4


def test_the_pressure_of_contact_follows_overlap_and_mean_speed_with_springs_in_series():
    """Overlap 0.3 − 0.1 = 0.2 mm in all, half of it 0.1 mm; K = 2 · 1e6 · 4e6/5e6 = 1.6e6, C = 2 · 100 · 300/400 = 150.

    By hand p = 1.6e6 · 1e-4 + 150 (0.5 − 0.3)/2 = 175 Pa.
    """
    left = WallTwin(0.057, 0.4, 0.0, theta_conv=0.0)
    right = replace(left, constants=FoldConstants(K_col_pa_m=4e6, C_col_pa_s_m=300.0))
    glottis = GlottisTwin((left, right))
    states = moved_to(left, 3e-4, 0.5), moved_to(right, -1e-4, -0.3)
    pressure = glottis.contact_pressure(states)
    assert pressure[1:-1] == pytest.approx(175.0, rel=1e-9)
    assert (pressure[[0, -1]] == 0).all()
    with_contact, without = (glottis.acceleration(states, 0.0, contact) for contact in (True, False))
    for wall, pushed, free in zip(glottis.walls, with_contact, without, strict=True):
        assert pushed[0] - free[0] == pytest.approx(-175.0 / wall.k.rho_s, rel=1e-9)


def test_a_wall_may_cross_the_midline_without_contact():
    glottis = GlottisTwin((MODAL, SLACK))
    states = moved_to(MODAL, 1e-3), moved_to(SLACK, -3e-3)
    assert (MODAL.medial[1:-1] - 1e-3 < 0).any()
    assert (glottis.contact_pressure(states) == 0).all()


def test_a_side_without_contact_stiffness_pushes_nothing():
    nothing = np.zeros((MODAL.nx, MODAL.ny))
    soft = MODAL.with_fields(K_col=nothing, C_col=nothing)
    states = moved_to(MODAL, 1e-3), moved_to(soft, 1e-3)
    for pair in ((MODAL, soft), (soft, MODAL), (soft, soft)):
        assert (GlottisTwin(pair).contact_pressure(states) == 0).all()


def test_the_air_sees_the_sum_of_both_gaps_in_slices_of_mean_width():
    """Inviscid uniform gaps: area by hand ∫ x (tan θ_l + tan θ_r) with the mean length, flow √(2P/ρ) times area."""
    no_viscosity = FoldConstants(mu_a_pa_s=0.0)
    left = WallTwin(0.057, 0.4, 0.05, theta_conv=0.0, constants=no_viscosity)
    right = WallTwin(0.2, 0.0, 0.15, theta_conv=0.0, constants=no_viscosity)
    air = GlottisTwin((left, right)).flow((left.zero_state(), right.zero_state()), 1000.0)
    length = (left.k.L + right.k.L) / 2
    posterior = left.k.L * np.tan(0.05) + right.k.L * np.tan(0.15)
    assert air.A_g_min == pytest.approx(posterior * length / 2, rel=1e-12)
    assert air.Q_g == pytest.approx(np.sqrt(2 * 1000.0 / 1.14) * posterior * length / 2, rel=1e-12)


def test_viscous_loss_counts_the_mean_node_distance_of_both_walls():
    """A channel of 40 µm from the outlet to the last row but one, wide at the inlet; by hand q = 2 P d³/(12 μ dy)."""
    walls = tuple(
        WallTwin(0.0, 0.4, 0.0, theta_conv=0.0, constants=FoldConstants(b_0_m=b, mu_a_pa_s=1e-3)) for b in (8e-3, 4e-3)
    )
    half_gap = np.where(np.arange(10) < 9, 2e-5, 4e-4)
    air = GlottisTwin(walls).flow([moved_to(wall, -half_gap) for wall in walls], 10.0)
    dy = (8e-3 + 4e-3) / 2 / 9
    assert air.flow_per_width[1:-1] == pytest.approx(2 * 10.0 * (4e-5) ** 3 / (12 * 1e-3 * dy), rel=1e-3)


def test_walls_on_different_grids_are_refused():
    with pytest.raises(ValueError, match="same number of nodes"):
        GlottisTwin((MODAL, replace(MODAL, nx=21)))


# ---- voices ---------------------------------------------------------------------------------------


def rate_hz(wave):
    """Rate at which a wave rises through its mean, Hz."""
    above = wave > wave.mean()
    rising = np.flatnonzero(~above[:-1] & above[1:])
    at = rising + (wave.mean() - wave[rising]) / (wave[rising + 1] - wave[rising])
    return (at.size - 1) / (np.ptp(at) * DEFAULT_STEP_S)


def differs_after(wave, period_s):
    """Rms difference of a wave from itself ``period_s`` later, as a share of its standard deviation."""
    lag = round(period_s / DEFAULT_STEP_S)
    return np.sqrt(np.mean((wave[lag:] - wave[:-lag]) ** 2)) / wave.std()


def voice(left, right, duration_s=0.6):
    """Record of the second half of a run at 1000 Pa."""
    glottis = GlottisTwin((left, right))
    record = glottis.march(glottis.initial_states(), 1000.0, DEFAULT_STEP_S, round(duration_s / DEFAULT_STEP_S))
    half = record.t > duration_s / 2
    return record._replace(
        t=record.t[half], A_g_min=record.A_g_min[half], Q_g=record.Q_g[half], mean_w=record.mean_w[half]
    )


def test_a_paralysed_and_abducted_side_vibrates_with_the_modal_side_as_in_a_prototype():
    record = voice(MODAL, SLACK, 0.4)
    assert rate_hz(record.mean_w[:, 0]) == pytest.approx(145.2, rel=0.005)
    assert rate_hz(record.mean_w[:, 1]) == pytest.approx(145.2, rel=0.005)
    assert record.Q_g.mean() == pytest.approx(1.75e-3, rel=0.01)
    assert record.A_g_min.min() == pytest.approx(0.7e-6, abs=0.05e-6)  # the slack side keeps a gap open
    level = record.A_g_min.min() + 0.02 * np.ptp(record.A_g_min)
    assert (record.A_g_min < level).mean() == pytest.approx(0.50, abs=0.01)


def slackened(q):
    """The modal fold with tension and coupling times q and mass over q (Steinecke & Herzel 1995)."""
    c = MODAL.constants
    scaled = {
        name: q * getattr(c, name)
        for name in ("sigma_1_muc_pa", "sigma_2_muc_pa", "K_coup_min_pa_m", "K_coup_max_pa_m")
    }
    wall = replace(MODAL, constants=replace(c, **scaled))
    return wall.with_fields(rho_s=wall.fields.rho_s / q)


@pytest.mark.slow
@pytest.mark.parametrize(("q", "fo_hz"), [(0.8, 140.5), (0.6, 136.3), (0.55, 135)])
def test_a_mildly_slack_side_is_entrained_one_to_one_and_swings_less(q, fo_hz):
    record = voice(MODAL, slackened(q))
    rates = [rate_hz(record.mean_w[:, side]) for side in (0, 1)]
    assert rates == pytest.approx([fo_hz, fo_hz], rel=0.01)
    assert np.ptp(record.mean_w[:, 1]) < 0.5 * np.ptp(record.mean_w[:, 0])
    assert differs_after(record.A_g_min, 1 / rates[0]) < 0.1


@pytest.mark.parametrize(
    ("q", "left_hz", "right_hz"), [(0.5, 132, 66), pytest.param(0.45, 122, 61, marks=pytest.mark.slow)]
)
def test_a_slacker_side_swings_once_in_two_cycles_of_the_other_as_in_a_prototype(q, left_hz, right_hz):
    record = voice(MODAL, slackened(q))
    rates = [rate_hz(record.mean_w[:, side]) for side in (0, 1)]
    assert rates == pytest.approx([left_hz, right_hz], rel=0.01)
    assert differs_after(record.A_g_min, 1 / rates[1]) < 0.2 < differs_after(record.A_g_min, 1 / rates[0])


@pytest.mark.slow
def test_the_slackest_side_shares_no_period_with_the_other():
    record = voice(MODAL, slackened(0.4), 0.8)
    left, right = (rate_hz(record.mean_w[:, side]) for side in (0, 1))
    assert left == pytest.approx(132, rel=0.02)
    assert 100 < right < 120
    assert all(differs_after(record.mean_w[:, 1], cycles / left) > 0.3 for cycles in range(1, 7))


def test_the_mirrored_fold_and_a_glottis_of_one_wall_run_alike():
    fold = FoldTwin(0.057, 0.4, 0.0)
    record = fold.run(fold.initial_state(), 1000.0, DEFAULT_STEP_S, 100)
    glottis = GlottisTwin((MODAL,))
    assert (glottis.march(glottis.initial_states(), 1000.0, DEFAULT_STEP_S, 100).final[0].w_m == record.final.w_m).all()
