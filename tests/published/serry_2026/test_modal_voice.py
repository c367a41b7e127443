"""The exemplar case of sustained modal phonation (paper, "Exemplar case"): what is read from its waveforms.

The paper prints SQ 1.52 and a closure quotient of 0.49; two earlier implementations of these equations gave f_o
149.6 Hz, exactly closed for 0.506 of the cycle, mean flow 1.29 L/s, SQ 1.52 (1.55 with closed below 2 % of the peak).
"""

import numpy as np
import pytest


def test_it_is_sustained_and_periodic(modal):
    assert modal.report.state == "periodic"
    assert modal.report.periodicity > 0.999
    peaks = modal.report.measures["peak_area_mm2"].value
    area = modal.arrays["glottal_area_m2"]
    last_tenth = area[-len(area) // 10 :].max() * 1e6
    assert last_tenth == pytest.approx(peaks, rel=5e-3)


@pytest.mark.parametrize(
    ("key", "value", "tolerance"),
    [
        ("fo_hz", 149.6, 0.1),
        ("speed_quotient", 1.52, 0.02),
        ("closed_quotient", 0.506, 0.005),
        ("mean_flow_ml_s", 1290, 10),
        ("contact_pressure_max_pa", 3457, 10),
    ],
)
def test_it_has_the_measures_of_earlier_implementations(modal, key, value, tolerance):
    assert modal.report.measures[key].value == pytest.approx(value, abs=tolerance)


def test_speed_and_closed_quotient_are_the_papers(modal):
    """SQ 1.52 to its last digit; CQ 0.49, whose closed threshold the paper does not state, to 0.02."""
    measures = modal.report.measures
    assert measures["speed_quotient"].value == pytest.approx(1.52, abs=0.01)
    assert measures["closed_quotient"].value == pytest.approx(0.49, abs=0.02)


def test_it_is_exactly_closed_for_half_of_the_time(modal):
    area = modal.arrays["glottal_area_m2"]
    assert (area[len(area) // 2 :] == 0).mean() == pytest.approx(0.506, abs=0.002)


def test_level_at_the_lips_is_within_two_decibels_of_the_reported_one(modal):
    """138 dB in earlier implementations, 136 dB reported for the authors' code; here 139.5 dB: higher by 1.5 dB."""
    assert modal.report.measures["spl_lips_db"].value == pytest.approx(138, abs=2)


def test_flow_is_no_scaled_copy_of_the_area_it_peaks_and_falls_before_it(modal_cycle):
    """Peaks at .50 (flow) and .61 (area) of the open phase."""
    span = modal_cycle.closing.stop - modal_cycle.opening.start
    flow_peak = (modal_cycle.flow_m3_s.argmax() - modal_cycle.opening.start) / span
    area_peak = (modal_cycle.area_m2.argmax() - modal_cycle.opening.start) / span
    assert flow_peak == pytest.approx(0.50, abs=0.01)
    assert area_peak == pytest.approx(0.61, abs=0.01)
    scale = np.dot(modal_cycle.area_m2, modal_cycle.flow_m3_s) / np.dot(modal_cycle.area_m2, modal_cycle.area_m2)
    away = np.abs(modal_cycle.flow_m3_s - scale * modal_cycle.area_m2).max() / modal_cycle.flow_m3_s.max()
    assert away > 0.1


def test_closing_is_faster_than_opening(modal_cycle):
    slope = np.diff(modal_cycle.area_m2)
    assert -slope.min() > 1.4 * slope.max()
