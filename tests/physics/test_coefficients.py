"""Prestrained coefficients: hand-computed values, limits, the independent twin, and refusal of slack folds."""

import math
from dataclasses import fields

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.support.coefficient_twin import coefficients as twin_coefficients
from vfcore.errors import ParameterError
from vfcore.fold.constants import FoldConstants
from vfcore.larynx.tissue.coefficients import coefficients
from vfcore.larynx.tissue.prestrain import active, passive

CONSTANTS = FoldConstants()

#: At strain 0.057, a_ta 0.4, computed by hand: (value, half a unit of its last digit).
HAND_VALUES = {
    "length_m": (15.85e-3, 0.0051e-3),
    "thickness_m": (4.86e-3, 0.005e-3),
    "sigma_muc_pa": (6490, 5),
    "sigma_lig_pa": (9230, 5),
    "sigma_ta_pa": (40500, 50),
    "E_lig_pa": (79200, 50),
    "E_ta_pa": (38000, 50),
    "membrane_tension_n_m": (7.25, 0.005),
    "beam_tension_n": (1.86, 0.005),
    "prestress_moment_n_m": (7.58e-3, 0.005e-3),
    "bending_stiffness_n_m2": (1.83e-5, 0.005e-5),
    "membrane_density_kg_m2": (0.973, 0.0005),
    "beam_density_kg_m": (0.0466, 0.00005),
}

TWIN_NAMES = {
    "stretch_ratio": "lam",
    "length_m": "L",
    "thickness_m": "b",
    "membrane_tension_n_m": "T_m_tilde",
    "membrane_shear_n_m": "G_m_tilde",
    "membrane_shear_viscosity_n_s_m": "eta_m_tilde",
    "membrane_density_kg_m2": "rho_s",
    "rotation_inertia_kg_m": "J_m",
    "beam_tension_n": "N_b_tilde",
    "bending_stiffness_n_m2": "mu_c_tilde",
    "prestress_moment_n_m": "M_bar",
    "beam_density_kg_m": "rho_l",
    "mucosa_depth_m": "d_muc",
    "sigma_muc_pa": "sigma_muc",
    "sigma_lig_pa": "sigma_lig",
    "sigma_ta_pa": "sigma_ta",
    "E_muc_pa": "E_muc",
    "E_lig_pa": "E_lig",
    "E_ta_pa": "E_ta",
}


@pytest.mark.parametrize("name", HAND_VALUES)
def test_a_coefficient_has_the_hand_computed_value(name):
    value, half_digit = HAND_VALUES[name]
    assert abs(getattr(coefficients(0.057, 0.4, CONSTANTS), name) - value) <= half_digit


@given(strain=st.floats(-0.4, 0.55), a_ta=st.floats(0, 1))
@settings(max_examples=200, deadline=None)
def test_every_coefficient_equals_the_twin(strain, a_ta):
    got, twin = coefficients(strain, a_ta, CONSTANTS), twin_coefficients(CONSTANTS, strain, a_ta)
    assert {field.name for field in fields(got)} == set(TWIN_NAMES)
    for name, twin_name in TWIN_NAMES.items():
        assert getattr(got, name) == pytest.approx(getattr(twin, twin_name), rel=1e-11), name


def test_without_strain_and_activation_the_fold_has_its_resting_size():
    c = coefficients(0.0, 0.0, CONSTANTS)
    assert (c.stretch_ratio, c.length_m, c.thickness_m) == (1.0, 15e-3, 5e-3)
    assert c.mucosa_depth_m == pytest.approx(5e-6 / 5e-3, rel=1e-12)
    assert c.membrane_density_kg_m2 == pytest.approx(1000 * 1e-3, rel=1e-12)
    assert c.rotation_inertia_kg_m == pytest.approx(1000 * 1e-3**2 / 12, rel=1e-12)
    assert c.beam_density_kg_m == pytest.approx(1030 * 6.1e-6 + 1050 * 40.9e-6, rel=1e-12)
    assert c.membrane_shear_n_m == pytest.approx(100 * 1e-3, rel=1e-12)
    # At strain 0 the linear part of each law is σ_1 (1000, 500, 2000 Pa) by construction.
    assert c.sigma_muc_pa == pytest.approx(1000 + 1000 * (math.exp(1.8) - 2.8), rel=1e-12)
    assert c.sigma_lig_pa == pytest.approx(500 + 1000 * (math.exp(2.1) - 3.1), rel=1e-12)
    assert c.sigma_ta_pa == pytest.approx(2000 + 1000 * (math.exp(0.45) - 1.45), rel=1e-12)
    assert c.membrane_tension_n_m == pytest.approx(1e-3 * c.sigma_muc_pa, rel=1e-12)
    assert c.beam_tension_n == pytest.approx(6.1e-6 * c.sigma_lig_pa + 40.9e-6 * c.sigma_ta_pa, rel=1e-12)


def test_two_layers_of_one_material_bend_as_one_bar_about_their_common_axis():
    """Equal moduli and no prestrain: E (I + offset² A) about the joint centroid, offset counted from the ligament."""
    same = FoldConstants(
        sigma_1_lig_pa=1000.0,
        sigma_1_ta_pa=1000.0,
        sigma_2_lig_pa=0.0,
        sigma_2_ta_pa=0.0,
        epsilon_1_lig=-0.5,
        epsilon_1_ta=-0.5,
    )
    c = coefficients(0.0, 0.0, same)
    E, b, d_lig, d_ta = 2000.0, 5e-3, 6.1e-6 / 5e-3, 40.9e-6 / 5e-3
    inertia = b * (d_lig**3 + d_ta**3) / 12
    # No net axial increment: the two layers stretch by α about the neutral line between their middles.
    alpha_ta = (d_lig + d_ta) * E * 6.1e-6 / (2 * E * (6.1e-6 + 40.9e-6))
    arm = (d_lig + d_ta) / 2
    assert c.bending_stiffness_n_m2 == pytest.approx(E * (inertia + arm * 40.9e-6 * alpha_ta), rel=1e-12)
    parallel_axis = E * (inertia + 6.1e-6 * 40.9e-6 / (6.1e-6 + 40.9e-6) * arm**2)
    assert c.bending_stiffness_n_m2 == pytest.approx(parallel_axis, rel=1e-12)


def test_activation_adds_tension_and_moment_to_the_beam_and_nothing_to_the_mucosa():
    calm, tense = coefficients(0.05, 0.0, CONSTANTS), coefficients(0.05, 1.0, CONSTANTS)
    assert tense.membrane_tension_n_m == calm.membrane_tension_n_m
    added = 1e5 * (1 - (0.05 - 0.3) ** 2)
    assert tense.sigma_ta_pa - calm.sigma_ta_pa == pytest.approx(added, rel=1e-12)
    arm = (6.1e-6 + 40.9e-6) / 5e-3 / 2 / math.sqrt(1.05)
    assert tense.prestress_moment_n_m - calm.prestress_moment_n_m == pytest.approx(arm * 40.9e-6 * added, rel=1e-12)


@given(
    strain=st.floats(-0.4, 0.6),
    law=st.sampled_from([(1000.0, -0.5, 1000.0, -0.3, 6.0), (2000.0, -0.5, 1000.0, -0.05, 9.0)]),
)
def test_the_passive_modulus_is_the_slope_of_the_stress(strain, law):
    h = 1e-6
    slope = (passive(strain + h, *law)[0] - passive(strain - h, *law)[0]) / (2 * h)
    assert passive(strain, *law)[1] == pytest.approx(slope, rel=1e-4)


@given(strain=st.floats(-1.5, 1.5), activation=st.floats(0, 1), width=st.floats(0, 5))
def test_the_active_stress_is_a_hump_that_never_pushes(strain, activation, width):
    stress, slope = active(strain, activation, 1e5, width, 0.3)
    assert 0 <= stress <= activation * 1e5
    assert active(0.3, activation, 1e5, width, 0.3)[0] == activation * 1e5
    if stress == 0 and activation > 0 and abs(strain - 0.3) > 1e-9:
        assert slope == 0


@pytest.mark.parametrize(
    ("strain", "a_ta", "changes", "name"),
    [
        (-0.4, 0.0, {"sigma_1_muc_pa": 0.0}, "membrane_tension_n_m"),
        (0.5, 1.0, {"sigma_2_ta_pa": 0.0, "sigma_1_ta_pa": 0.0, "sigma_a_max_ta_pa": 1e5}, "bending_stiffness_n_m2"),
        (0.6, 1.0, {"sigma_2_ta_pa": 0.0, "sigma_1_ta_pa": 0.0, "sigma_a_max_ta_pa": 1e6}, "axial stiffness"),
        (0.1, 0.0, dict.fromkeys(("sigma_1_ta_pa", "sigma_2_ta_pa", "sigma_1_lig_pa", "sigma_2_lig_pa"), 0.0), "axial"),
    ],
)
def test_a_fold_without_stiffness_is_refused_by_name(strain, a_ta, changes, name):
    with pytest.raises(ParameterError, match=f"{name}.*no stiffness left"):
        coefficients(strain, a_ta, FoldConstants(**changes))
