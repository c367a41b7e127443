"""f_o, quotients and areas on pulses whose values follow from their formulas."""

import numpy as np
import pytest

from tests.support.synthetic_waves import (
    MM2,
    RATE_HZ,
    alternating,
    raised_pulse,
    signals_from,
    steady_phase,
    times,
    triangle,
)
from vfcore.measures import measure_all

RATES = [60.0, 97.3, 149.6, 200.01, 333.3, 499.7]
SHAPES = [(0.506, 1.52), (0.1, 1.0), (0.7, 2.5), (0.3, 0.8)]
T = times()
# Where sin²(πu/2) crosses 0.1 % of its peak, as a fraction of the rise or fall.
FOOT = 2 / np.pi * np.arcsin(np.sqrt(1e-3))


def value(area, key, **changes):
    return measure_all(signals_from(area, **changes)).measures[key].value


@pytest.mark.parametrize("fo_hz", RATES)
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_f_o_is_right_to_a_hundredth_of_a_percent(fo_hz, shape, dtype):
    area = (20 * MM2 * triangle(steady_phase(T, fo_hz), *shape)).astype(dtype)
    assert value(area, "fo_hz") == pytest.approx(fo_hz, rel=1e-4)


@pytest.mark.parametrize("fo_hz", RATES)
@pytest.mark.parametrize(("closed", "speed"), SHAPES)
def test_closed_quotient_of_a_triangle_is_interpolated_between_samples(fo_hz, closed, speed):
    area = 20 * MM2 * triangle(steady_phase(T, fo_hz), closed, speed)
    expected = closed + 1e-3 * (1 - closed)  # the lowest 0.1 % of both flanks counts as closed
    assert value(area, "closed_quotient") == pytest.approx(expected, abs=5e-4)
    assert value(area, "open_quotient") == pytest.approx(1 - expected, abs=5e-4)


@pytest.mark.parametrize("fo_hz", RATES)
@pytest.mark.parametrize(("closed", "speed"), SHAPES)
def test_quotients_of_a_smooth_pulse(fo_hz, closed, speed):
    area = 20 * MM2 * raised_pulse(steady_phase(T, fo_hz), closed, speed)
    fall = (1 - closed) / (1 + speed)
    sample = fo_hz / RATE_HZ  # of a cycle; a quarter of one is allowed for each crossing, half of one for the peak
    assert value(area, "closed_quotient") == pytest.approx(closed + FOOT * (1 - closed), abs=0.5 * sample)
    assert value(area, "speed_quotient") == pytest.approx(speed, rel=0.5 * sample * (1 / fall + 1 / (fall * speed)))


def test_the_closed_threshold_is_a_thousandth_of_the_peak():
    pulse = triangle(steady_phase(T, 120.0), 0.5, 1.0)
    assert value(20 * MM2 * (pulse + 0.0005), "closed_quotient") == pytest.approx(0.50025, abs=5e-4)
    assert value(20 * MM2 * (pulse + 0.002), "closed_quotient") == 0.0


def test_each_cycle_is_measured_against_its_own_peak():
    phase = steady_phase(T, 140.0)
    area = 20 * MM2 * triangle(phase, 0.4, 1.5) * alternating(phase, 0.5)
    report = measure_all(signals_from(area))
    assert report.state == "subharmonic"
    assert report.measures["closed_quotient"].value == pytest.approx(0.4006, abs=1e-3)
    assert report.measures["speed_quotient"].value == pytest.approx(1.5, rel=0.02)
    assert report.measures["peak_area_mm2"].value == pytest.approx(15.0, rel=0.01)


def test_without_closure_the_open_phase_runs_from_minimum_to_minimum():
    phase = np.mod(steady_phase(T, 131.3), 1.0)
    rise = 0.65
    area = 30 - 10 * np.cos(np.where(phase < rise, np.pi * phase / rise, np.pi * (1 + (phase - rise) / (1 - rise))))
    report = measure_all(signals_from(area * MM2))
    assert report.measures["speed_quotient"].value == pytest.approx(rise / (1 - rise), rel=0.01)
    assert report.measures["glottal_gap_area_mm2"].value == pytest.approx(20.0, rel=1e-3)
    assert report.measures["peak_area_mm2"].value == pytest.approx(40.0, rel=1e-3)


def test_a_cycle_with_two_openings_runs_from_the_first_to_the_last():
    phase = steady_phase(T, 112.0)
    area = 20 * MM2 * (raised_pulse(phase, 0.7, 1.0) + 0.4 * raised_pulse(phase - 0.35, 0.8, 1.0))
    report = measure_all(signals_from(area))
    assert report.state == "periodic"
    small_foot = 2 / np.pi * np.arcsin(np.sqrt(1e-3 / 0.4))
    closed = 1 - 0.3 * (1 - FOOT) - 0.2 * (1 - small_foot)
    assert report.measures["closed_quotient"].value == pytest.approx(closed, abs=2e-3)
    opening, closing = 0.15 * (1 - FOOT), 0.55 - 0.15 - 0.1 * small_foot
    assert report.measures["speed_quotient"].value == pytest.approx(opening / closing, rel=0.02)


@pytest.mark.parametrize("fo_hz", RATES)
def test_the_cycle_to_show_is_one_period_cut_while_closed(fo_hz):
    area = 20 * MM2 * triangle(steady_phase(T, fo_hz), 0.5, 1.5)
    start, stop = measure_all(signals_from(area)).cycle_bounds
    assert stop - start == pytest.approx(RATE_HZ / fo_hz, abs=1.0)
    assert start >= len(T) // 2
    assert area[start] == area[stop] == 0.0
    # The cut lies in the middle of the closed half of the cycle.
    assert np.mod(steady_phase(start / RATE_HZ, fo_hz), 1.0) == pytest.approx(0.75, abs=0.05)


@pytest.mark.parametrize("fo_hz", RATES)
def test_all_whole_cycles_of_the_last_half_are_used(fo_hz):
    area = 20 * MM2 * triangle(steady_phase(T, fo_hz), 0.5, 1.5)
    assert measure_all(signals_from(area)).cycles in (int(fo_hz / 2), int(fo_hz / 2) - 1)


def test_the_first_half_of_the_run_does_not_count():
    area = 20 * MM2 * triangle(steady_phase(T, 150.0), 0.5, 1.5)
    disturbed = np.where(T < 0.5, 90 * MM2 * triangle(steady_phase(T, 83.0), 0.1, 3.0), area)
    assert (
        measure_all(signals_from(disturbed)).measures["closed_quotient"]
        == (measure_all(signals_from(area)).measures["closed_quotient"])
    )
