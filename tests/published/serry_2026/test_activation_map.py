"""CT × TA at LCA = IA = .6, PCA 0, 1000 Pa, on a coarse grid: results of two earlier implementations, and the trends.

f_o 110–208 Hz, 126–208 Hz for CT ≥ .2 (143–221 Hz for CT ≥ .2, TA ≤ .4 with a posturing length of 15 mm); up with CT
with falling slope, down with TA for CT ≥ .2; mean flow falls with TA and by about a fifth over CT; nothing is silent.
"""

import numpy as np
import pytest

import vfcore
from vfcore.spec.larynx import PAPER_LARYNX
from vfcore.spec.simulation import Activation, Simulation

LEVELS = np.linspace(0, 1, 6)


def net(cts, tas, **overrides):
    """Reports at every (CT, TA)."""
    larynx = PAPER_LARYNX.override(overrides)
    return [
        [
            vfcore.simulate(Simulation(Activation(lca=0.6, ia=0.6, pca=0.0, ct=ct, ta=ta), larynx=larynx)).report
            for ta in tas
        ]
        for ct in cts
    ]


@pytest.fixture(scope="module")
def reports():
    return net(LEVELS, LEVELS)


def table(reports, key):
    return np.array([[report.measures[key].value for report in row] for row in reports])


def test_every_posture_vibrates(reports):
    assert {report.state for row in reports for report in row} <= {"periodic", "irregular"}
    assert all(report.state == "periodic" for row in reports[1:] for report in row)


def test_the_pitch_has_the_published_range(reports):
    pitch = table(reports, "fo_hz")
    assert (pitch.min(), pitch.max()) == pytest.approx((110, 208), abs=1)
    assert (pitch[1:].min(), pitch[1:].max()) == pytest.approx((126, 208), abs=1)


def test_the_pitch_has_the_published_range_with_a_posturing_length_of_fifteen_millimetres():
    pitch = table(net(LEVELS[1:], LEVELS[:3], L_0_posture_m=0.015), "fo_hz")
    assert (pitch.min(), pitch.max()) == pytest.approx((143, 221), abs=1)


def test_ct_raises_the_pitch_less_and_less(reports):
    pitch = table(reports, "fo_hz")
    rise = np.diff(pitch, axis=0)
    assert (rise > 0).all()
    assert (np.diff(rise, axis=0)[1:] < 0).all() and (rise[-1] < 0.5 * rise[1]).all()


def test_ta_lowers_the_pitch_once_ct_is_active(reports):
    assert (np.diff(table(reports, "fo_hz")[1:], axis=1) < 0).all()


def test_ta_lowers_the_mean_flow_and_ct_hardly_changes_it(reports):
    flow = table(reports, "mean_flow_ml_s")
    assert (np.diff(flow, axis=1) < 0).all()
    over_ct = flow[-1] / flow[0] - 1
    assert over_ct[0] == pytest.approx(-0.2, abs=0.05)
    assert np.abs(flow[1:].max(axis=0) / flow[1:].min(axis=0) - 1).max() < 0.3


def test_weak_vibration_continues_at_high_ta_without_ct(reports):
    """114–127 Hz with a closed quotient below .2 where the paper has no sustained oscillation."""
    for report in reports[0][2:]:
        assert 109 < report.measures["fo_hz"].value < 128
        assert report.measures["closed_quotient"].value < 0.2
