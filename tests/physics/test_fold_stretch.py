"""Finite stretch of the fold: stress, tension and axial force at the strain of the swing, and the resulting voice."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from tests.support import stretch_twin
from tests.support.coefficient_twin import coefficients
from tests.support.coefficient_twin import layer_stress as stress_of_the_paper
from tests.support.fold_twin import FoldTwin
from tests.support.glottis_twin import GlottisTwin
from tests.support.patched_twin import patched
from tests.support.wall_twin import WallTwin
from vfcore.fold.constants import FoldConstants
from vfcore.spec.simulation import DEFAULT_STEP_S

MODAL = WallTwin(0.057, 0.4, 0.0, stretch="finite")
#: Below and above the exponential's onset of every layer, and beyond both ends of the active stress.
STRAINS = np.array([-0.8, -0.35, -0.1, 0.0, 0.3, 0.9, 1.4])


# ---- laws -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("layer", ["muc", "lig", "ta"])
def test_the_stress_is_that_of_the_constitutive_law_at_every_strain(layer):
    c = FoldConstants()
    expected = [stress_of_the_paper(c, layer, 0.7, complex(strain)).real for strain in STRAINS]
    assert stretch_twin.layer_stress(c, layer, 0.7, STRAINS) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("layer", ["muc", "lig", "ta"])
def test_the_work_is_the_integral_of_the_stress(layer):
    c = FoldConstants()
    kinks = [-0.7, -0.3, -0.05, 1.3]
    expected = [
        quad(lambda e: float(stretch_twin.layer_stress(c, layer, 0.7, e)), -0.4, end, points=kinks, epsabs=1e-7)[0]
        for end in STRAINS
    ]
    assert stretch_twin.layer_work(c, layer, 0.7, -0.4, STRAINS) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("strain", [-0.315, 0.057, 0.23])
def test_a_straight_fold_has_the_tension_of_the_prestrain(strain):
    wall = replace(MODAL, strain=strain, a_ta=0.7)
    k = coefficients(wall.constants, strain, 0.7)
    assert wall.row_tension(np.zeros((wall.n, wall.ny))) == pytest.approx(k.T_m_tilde, rel=1e-12)
    assert wall.beam_tension(np.zeros(wall.n)) == pytest.approx(k.N_b_tilde, rel=1e-12)


def test_a_half_wave_of_3_mm_stretches_the_modal_fold_to_a_strain_of_0_150():
    """By hand: e = (A π/2L)² = (3 · π/(2 · 15.855))² = 0.0883, ε = 0.057 + 1.057 e = 0.1504, λ = 1.057.

    σ_muc = 2000 · 0.6504 + 1000 (e^{6 · 0.4504} − 1 − 6 · 0.4504) = 12.51 kPa against 6.49 kPa at rest, so T̃ grows from
    7.25 to 13.97 N/m. The grid's slopes fall short of those of the sine by (π dx/L)²/24.
    """
    wall = replace(MODAL, nx=200)
    w = np.outer(3e-3 * np.sin(np.pi * wall.x / wall.k.L), [1.0, *(wall.ny - 1) * [0.0]])[1:-1]
    tension = wall.row_tension(w)
    assert tension[0] == pytest.approx(13.97, abs=0.01)
    assert tension[1:] == pytest.approx(wall.k.T_m_tilde, rel=1e-12)
    # σ_lig = 1000 · 0.6504 + 1000 (e^{7 · 0.4504} − 1 − 7 · 0.4504) = 19.90 kPa; σ_ta = 4000 · 0.6504
    # + 1000 (e^{9 · 0.2004} − 1 − 9 · 0.2004) + 40,000 (1 − 0.1496²) = 44.97 kPa;
    # Ñ_b = λ^{3/2} (6.1 · 19.90 + 40.9 · 44.97) mN
    assert wall.beam_tension(w[:, 0]) == pytest.approx(2.131, abs=0.001)


def test_a_stiffer_patch_counts_more_in_the_stretch_of_its_row():
    wall = MODAL.with_fields(tau=np.where(np.arange(19)[:, None] < 5, 4.0, 1.0) * np.ones(10))
    bent_there, bent_elsewhere = np.zeros((2, wall.n, wall.ny))
    bent_there[2], bent_elsewhere[12] = 1e-3, 1e-3
    strain = [
        wall.strain + wall.k.lam * stretch_twin.mean_square_stretch(wall.whole(w), wall.dx, wall.fields.tau)[0]
        for w in (bent_there, bent_elsewhere)
    ]
    assert strain[0] - wall.strain == pytest.approx(4 * (strain[1] - wall.strain), rel=1e-12)
    assert wall.row_tension(bent_there)[0] == pytest.approx(
        stretch_twin.membrane_tension(wall.constants, wall.k, strain[0]), rel=1e-12
    )


# ---- motion ---------------------------------------------------------------------------------------


def free_swing(wall):
    """Start states of a free swing of 1.6 mm with some beam motion, without air."""
    bow = np.sin(np.pi * wall.x[1:-1] / wall.k.L)
    rows = 1 + 0.2 * np.cos(np.pi * wall.y / wall.k.b)
    return (wall.zero_state()._replace(w_m=-1.6e-3 * np.outer(bow, rows), v_b=0.2 * bow),)


@pytest.mark.parametrize("shear", ["kelvin_voigt", "rotation"])
@pytest.mark.parametrize("patch", [False, True])
def test_the_step_is_of_second_order_under_finite_stretch(shear, patch):
    """Against the adaptive integrator of eighth order; every damper is on, and nothing touches."""
    wall = WallTwin(0.057, 0.4, 0.5, theta_conv=0.3, nx=12, ny=6, shear=shear, stretch="finite")
    glottis = GlottisTwin((patched(wall) if patch else wall,))
    start, end = free_swing(wall), 112 * DEFAULT_STEP_S
    [[exact]] = glottis.reference(start, [end])
    splits, errors = np.array([4, 8, 16]), []
    for split in splits:
        dt = DEFAULT_STEP_S / split
        record = glottis.march(glottis.half_step_back(start, dt), 0.0, dt, 112 * split)
        assert record.p_col_max.max() == 0
        errors.append(np.abs(record.final[0].w_m - exact.w_m).max() / np.abs(exact.w_m).max())
    assert -np.polyfit(np.log(splits), np.log(errors), 1)[0] == pytest.approx(2, abs=0.2)
    assert errors[-1] < 1e-3


@pytest.mark.parametrize(("along", "grids"), [("x", ((9, 6), (17, 6), (33, 6))), ("y", ((9, 9), (9, 17), (9, 33)))])
def test_the_grid_is_of_second_order_under_finite_stretch(along, grids):
    """Differences between successive halvings of the spacing at common nodes, after 2 ms of a free swing."""
    shapes = []
    for nx, ny in grids:
        wall = WallTwin(0.057, 0.4, 0.5, theta_conv=0.3, nx=nx, ny=ny, stretch="finite")
        [[state]] = GlottisTwin((wall,)).reference(free_swing(wall), [2e-3], tolerance=1e-8)
        whole = wall.whole(state.w_m)
        shapes.append(whole[:: (nx - 1) // 8] if along == "x" else whole[:, :: (ny - 1) // 8])
    differences = [np.abs(fine - coarse).max() for coarse, fine in zip(shapes[:-1], shapes[1:], strict=True)]
    assert np.log2(differences[0] / differences[1]) == pytest.approx(2, abs=0.3)
    assert differences[1] < 0.02 * np.abs(shapes[-1]).max()


def test_a_small_swing_is_that_of_the_linear_tension():
    w_m = 1e-5 * np.random.default_rng(3).standard_normal((MODAL.n, MODAL.ny))
    linear, finite = (replace(MODAL, stretch=stretch).tension_force(w_m) for stretch in ("linear", "finite"))
    assert 0 < np.abs(finite - linear).max() < 3e-3 * np.abs(linear).max()


# ---- voice ----------------------------------------------------------------------------------------


def voice(pressure_pa, duration_s=0.4):
    """f_o in Hz, mean flow in mL/s and peak area in mm² over the whole cycles of the second half of a run."""
    wall = FoldTwin(0.057, 0.4, 0.0, stretch="finite")
    record = wall.run(wall.initial_state(), pressure_pa, DEFAULT_STEP_S, round(duration_s / DEFAULT_STEP_S))
    half = record.t > duration_s / 2
    area, flow = record.A_g_min[half], record.Q_g[half]
    level = area.max() / 2
    rising = np.flatnonzero((area[:-1] < level) & (area[1:] >= level))
    at = rising + (level - area[rising]) / (area[rising + 1] - area[rising])
    cycles = slice(rising[0] + 1, rising[-1] + 1)
    return (at.size - 1) / (np.ptp(at) * DEFAULT_STEP_S), flow[cycles].mean() * 1e6, area.max() * 1e6


@pytest.mark.parametrize(
    ("pressure_pa", "fo_hz", "mean_flow_ml_s", "peak_area_mm2"),
    [
        (600.0, 161.2, 467, 47),
        pytest.param(1000.0, 176.1, 796, 65, marks=pytest.mark.slow),
        pytest.param(1500.0, 190.9, 981, 70.5, marks=pytest.mark.slow),
        (2000.0, 202.9, 1034, 73),
    ],
)
def test_pitch_rises_with_the_lung_pressure_and_the_flow_saturates_as_in_a_prototype(
    pressure_pa, fo_hz, mean_flow_ml_s, peak_area_mm2
):
    """A prototype with another step (1.8 to 7 µs) found the numbers."""
    got = voice(pressure_pa)
    assert got[0] == pytest.approx(fo_hz, rel=0.005)
    assert got[1] == pytest.approx(mean_flow_ml_s, rel=0.015)
    assert got[2] == pytest.approx(peak_area_mm2, rel=0.015)
