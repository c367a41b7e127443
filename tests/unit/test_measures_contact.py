"""Contact measures on pulses of contact whose values are known."""

import numpy as np
import pytest

from tests.support.synthetic_waves import MM2, alternating, raised_pulse, signals_from, steady_phase, times
from vfcore.measures import measure_all

T = times()
RATES = [60.0, 149.6, 333.3]


def contact_of(phase, pressure, area_m2=None, location=0.5, glottal_closed=0.5):
    signals = signals_from(
        20 * MM2 * raised_pulse(phase, glottal_closed, 1.5),
        contact_pressure_max_pa=pressure,
        contact_location=np.where(pressure != 0, location, np.nan),
        contact_area_m2=np.zeros(len(T)) if area_m2 is None else area_m2,
    )
    return measure_all(signals).measures


def bump(phase, begin, end):
    """Half a sine over the part of the cycle from ``begin`` to ``end``, else 0."""
    u = (np.mod(phase, 1.0) - begin) / (end - begin)
    return np.where((u > 0) & (u < 1), np.sin(np.pi * u), 0.0)


@pytest.mark.parametrize("fo_hz", RATES)
def test_pressure_and_impulse_of_a_half_sine(fo_hz):
    phase = steady_phase(T, fo_hz)
    measures = contact_of(phase, 3000 * bump(phase, 0.55, 0.85))
    assert measures["contact_pressure_max_pa"].value == pytest.approx(3000.0, rel=5e-3)
    assert measures["contact_impulse_pa_s"].value == pytest.approx(3000 * 2 / np.pi * 0.3 / fo_hz, rel=1e-3)


def test_negative_pressure_at_separation_adds_nothing_to_the_impulse():
    phase = steady_phase(T, 120.0)
    push = 3000 * bump(phase, 0.55, 0.85)
    with_pull = contact_of(phase, push - 400 * bump(phase, 0.86, 0.95))
    assert with_pull["contact_impulse_pa_s"] == contact_of(phase, push)["contact_impulse_pa_s"]


def test_pressure_and_location_are_means_over_cycles_of_the_largest():
    phase = steady_phase(T, 150.0)
    first = alternating(phase, 0.0) == 1.0
    # The contact lasts across the middle of the closed phase, and its place moves during it.
    measures = contact_of(
        phase,
        np.where(first, 4000.0, 2000.0) * bump(phase, 0.6, 0.9),
        location=np.where(np.mod(phase, 1) < 0.7, 0.1, np.where(first, 0.4, 0.8)),
    )
    assert measures["contact_pressure_max_pa"].value == pytest.approx(3000.0, rel=0.01)
    assert measures["contact_location"].value == pytest.approx(0.6, abs=0.01)


def test_location_leaves_out_cycles_without_contact():
    phase = steady_phase(T, 150.0)
    measures = contact_of(phase, 4000.0 * bump(phase, 0.6, 0.9) * alternating(phase, 0.0), location=0.3)
    assert measures["contact_location"].value == pytest.approx(0.3)
    assert measures["contact_pressure_max_pa"].value == pytest.approx(2000.0, rel=0.02)


def test_folds_that_never_touch_have_zero_contact_and_no_place():
    measures = contact_of(steady_phase(T, 150.0), np.zeros(len(T)))
    for key in ("contact_pressure_max_pa", "contact_impulse_pa_s", "contact_area_mm2", "contact_quotient"):
        assert measures[key].value == 0.0
    assert measures["contact_location"].value is None
    assert "never touch" in measures["contact_location"].reason


@pytest.mark.parametrize("fo_hz", RATES)
def test_contact_area_and_quotient(fo_hz):
    phase = steady_phase(T, fo_hz)
    measures = contact_of(phase, 1000 * bump(phase, 0.5, 0.9), 25 * MM2 * bump(phase, 0.5, 0.9))
    assert measures["contact_area_mm2"].value == pytest.approx(25.0, rel=5e-3)
    assert measures["contact_area_fraction"].value == pytest.approx(25.0 / (15.85 * 4.86), rel=5e-3)
    above_a_quarter = 1 - 2 * np.arcsin(0.25) / np.pi
    assert measures["contact_quotient"].value == pytest.approx(0.4 * above_a_quarter, abs=2 * fo_hz / 35_000)
