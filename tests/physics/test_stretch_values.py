"""Voices with finite stretch and with two sides: values of an independent implementation, and the linear limit."""

import numpy as np
import pytest

import vfcore
from tests.support.fold_harness import MODAL, advance, beam, membrane, product_and_twin
from vfcore.fold.march import TimeMarch
from vfcore.spec.request import resolve
from vfcore.spec.simulation import DEFAULT_STEP_S

POSTURE = {"strain": 0.057, "glottal_half_angle_rad": 0.0}


def measures(**patch):
    """State and values of a run of a second."""
    report = vfcore.simulate(resolve(patch | {"run": {"duration_s": 1.0}})).report
    return report.state, {key: measure.value for key, measure in report.measures.items()}


@pytest.mark.parametrize(
    ("pressure_pa", "fo_hz", "mean_flow_ml_s"),
    [(600, 161.2, 467), (1000, 176.1, 796), (1500, 190.9, 981), (2000, 202.9, 1034)],
)
def test_with_finite_stretch_pitch_rises_with_pressure_and_the_flow_stays_in_bounds(pressure_pa, fo_hz, mean_flow_ml_s):
    state, values = measures(
        posture=POSTURE, activation={"ta": 0.4}, subglottal_pressure_pa=pressure_pa, model={"stretch": "finite"}
    )
    assert state == "periodic"
    assert values["fo_hz"] == pytest.approx(fo_hz, rel=0.01)
    assert values["mean_flow_ml_s"] == pytest.approx(mean_flow_ml_s, rel=0.04)
    if pressure_pa == 2000:
        assert values["peak_area_mm2"] == pytest.approx(73, rel=0.03)


def test_a_tense_and_a_slack_side_vibrate_at_one_pitch():
    state, values = measures(
        left={"posture": POSTURE, "activation": {"ta": 0.4}},
        right={"posture": {"strain": 0.057, "glottal_half_angle_rad": 0.1}, "activation": {"ta": 0.0}},
        subglottal_pressure_pa=1000,
    )
    assert state == "periodic"
    assert values["fo_hz"] == pytest.approx(145.2, rel=0.01)
    assert values["mean_flow_ml_s"] == pytest.approx(1750, rel=0.04)
    assert values["closed_quotient"] == pytest.approx(0.50, abs=0.02)


@pytest.mark.kernel
@pytest.mark.parametrize("shear", ["kelvin_voigt", "rotation"])
def test_without_swing_finite_stretch_is_linear(shear):
    """While the folds have moved less than 1 µm, the stretch is below 1e-8 and the motion the same to a millionth."""
    motions = []
    for stretch in ("linear", "finite"):
        glottis, _ = product_and_twin(**MODAL, nx=12, ny=6, shear=shear, stretch=stretch)
        march = TimeMarch(glottis, DEFAULT_STEP_S, 100.0)
        march.start(0, None)
        advance(march, 4)
        motions.append((membrane(march).copy(), beam(march).copy()))
    for linear, finite in zip(*motions, strict=True):
        assert 1e-9 < np.abs(linear).max() < 3e-6
        assert np.abs(finite - linear).max() < 1e-6 * np.abs(linear).max()
