"""Flow measures on the Liljencrants–Fant pulse and on ramps, whose values are known."""

import numpy as np
import pytest

from tests.support.synthetic_waves import (
    MM2,
    RATE_HZ,
    LiljencrantsFant,
    raised_pulse,
    signals_from,
    steady_phase,
    times,
)
from vfcore.measures import measure_all

T = times()
RATES = [60.0, 97.3, 149.6, 233.7]
ML = 1e-6


def flow_measures(flow_m3_s, fo_hz):
    area = 20 * MM2 * raised_pulse(steady_phase(T, fo_hz), 0.5, 1.5)
    return measure_all(signals_from(area, glottal_flow_m3_s=flow_m3_s)).measures


def gaussian_smoothed_minimum(slope, fo_hz, sigma_s):
    """Smallest value of the 1-periodic ``slope`` after a Gaussian of ``sigma_s`` at rate ``fo_hz``, by quadrature."""
    sigma = sigma_s * fo_hz
    phase = np.arange(0.0, 1.0, sigma / 200)
    offsets = np.linspace(-6, 6, 481)
    weights = np.exp(-(offsets**2) / 2)
    at = phase[np.argmin(slope(phase))] + np.linspace(-3, 3, 301) * sigma
    return (slope(at[:, None] + sigma * offsets) @ weights / weights.sum()).min()


@pytest.mark.parametrize("fo_hz", RATES)
@pytest.mark.parametrize("return_time", [0.1, 0.03, 0.008])
def test_lf_pulse_has_its_declination_rate_and_amplitude_quotient(fo_hz, return_time):
    pulse = LiljencrantsFant(t_a=return_time)
    flow = 50 * ML + 100 * ML * pulse.flow(steady_phase(T, fo_hz)) / pulse.peak_flow
    measures = flow_measures(flow, fo_hz)
    # Gain −3 dB at 3 kHz: exp(−(2π·3000·σ)²/2) = 1/√2.
    fall = -gaussian_smoothed_minimum(pulse.slope, fo_hz, np.sqrt(np.log(2)) / (2 * np.pi * 3000.0))
    in_litres = 0.1 * fo_hz / pulse.peak_flow
    assert measures["mfdr_l_s2"].value == pytest.approx(fall * in_litres, rel=0.01)
    assert measures["naq"].value == pytest.approx(pulse.peak_flow / fall, rel=0.01)
    assert measures["ac_flow_ml_s"].value == pytest.approx(100.0, rel=1e-3)
    assert measures["min_flow_ml_s"].value == pytest.approx(50.0, rel=1e-3)


def test_a_slow_return_passes_the_low_pass_unchanged():
    pulse = LiljencrantsFant(t_a=0.1)
    flow = 100 * ML * pulse.flow(steady_phase(T, 60.0)) / pulse.peak_flow
    assert flow_measures(flow, 60.0)["mfdr_l_s2"].value == pytest.approx(0.1 * 60 / pulse.peak_flow, rel=0.02)


@pytest.mark.parametrize("fo_hz", [61.0, 97.0, 151.0])  # half a cycle is left over in half a second
def test_mean_flow_is_taken_over_whole_cycles(fo_hz):
    phase = np.mod(steady_phase(T, fo_hz), 1.0)
    flow = 300 * ML * np.where(phase < 0.4, 2.5, 0.0)
    assert flow_measures(flow, fo_hz)["mean_flow_ml_s"].value == pytest.approx(300.0, rel=4 * fo_hz / RATE_HZ)


def test_mean_flow_of_a_silent_glottis_is_its_leak():
    report = measure_all(signals_from(5 * MM2 + 0 * T, glottal_flow_m3_s=210 * ML + 0 * T))
    assert report.state == "none"
    assert report.measures["mean_flow_ml_s"].value == pytest.approx(210.0)
    assert report.measures["ac_flow_ml_s"].value is None


def test_a_flow_that_never_falls_has_no_amplitude_quotient():
    measures = flow_measures(100 * ML + 0 * T, 120.0)
    assert measures["naq"].value is None
    assert "does not fall" in measures["naq"].reason
    assert measures["ac_flow_ml_s"].value == 0.0
