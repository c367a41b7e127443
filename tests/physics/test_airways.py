"""Two-way coupling: the flow between two airways against its twin, in its limits, and its energy."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.support.airways_march import alone, together
from tests.support.airways_twin import AirwaysTwin, law_of
from vfcore.airways.coupled import LUNG_RESISTANCE_PA_S_M3, STEADY_BELOW_HZ, Airways, airways
from vfcore.airways.resonances import closed_glottis_formants, input_impedance
from vfcore.airways.subglottal import subglottal_tract
from vfcore.airways.tract import Tract
from vfcore.errors import ParameterError
from vfcore.fold.form import LANES
from vfcore.kernels import airways as kernel
from vfcore.spec.simulation import DEFAULT_STEP_S, SECTION_TRAVEL_S, VOWELS

RHO, C = 1.14, 350.0
MALE = airways("a", RHO, C, DEFAULT_STEP_S)
ONE = airways("a", RHO, C, SECTION_TRAVEL_S)
UNCOMPILED = os.environ.get("NUMBA_DISABLE_JIT") == "1"  # the same tests in plain Python, on fewer steps
ROOT = Path(__file__).resolve().parents[2]


def law(A, B, width, drop):
    """Conductance and viscous share of these slices at a pressure drop, as the kernel takes them."""
    root = np.sqrt(B**2 + 4 * A * drop)
    flow, slope = np.sum(width * 2 * drop / (B + root)), np.sum(width / root)
    return flow / np.sqrt(drop), kernel.viscous_share(flow, slope, drop)


def slices(seed, count=20):
    """A, B and widths of the slices of a glottis with gaps between 0.05 and 1 mm."""
    gap = np.random.default_rng(seed).uniform(5e-5, 1e-3, count)
    return 0.5 * RHO / gap**2, 12 * 1.8e-5 * 2e-3 / gap**3, np.full(count, 8e-4)


@pytest.mark.kernel
@given(seed=st.integers(0, 10**6), D=st.floats(10, 5000), guess=st.floats(0.7, 1.4))
def test_the_flow_is_the_root_for_the_sum_of_all_slices(seed, D, guess):
    A, B, width = slices(seed)
    Z, flow_of = 9e6, law_of(A, B, width)
    twin = AirwaysTwin(ONE)
    twin.below.impedance = twin.above.impedance = np.array([Z / 2])
    low, high = 0.0, D
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if middle + Z * flow_of(middle) < D else (low, middle)
    drop = guess * low
    found = kernel.glottal_flow(D, Z, *law(A, B, width, drop), np.sqrt(drop))
    assert abs(found - flow_of(low)) < 1e-3 * flow_of(low)


@pytest.mark.kernel
def test_for_equal_slices_the_flow_does_not_depend_on_the_previous_drop():
    A, B, width = (np.full(20, value) for value in (0.57 / 3e-4**2, 4e-7 / 3e-4**3, 8e-4))
    far = law(A, B, width, 50.0)
    near = law(A, B, width, 900.0)
    flows = [kernel.glottal_flow(800.0, 9e6, *one, np.sqrt(at)) for one, at in ((far, 50.0), (near, 900.0))]
    assert flows[0] == pytest.approx(flows[1], rel=1e-9)


@pytest.mark.kernel
def test_a_closed_glottis_at_rest_carries_the_lung_pressure_and_nothing_moves():
    air = MALE.new_buffer(1000.0)
    for _ in range(50):
        kernel.advance_airways(air, 1000.0, 0.0, 1.0)
    assert air[kernel.INLET] == 1000.0 and air[kernel.OUTLET] == 0.0 and air[kernel.FLOW] == 0.0


@pytest.mark.kernel
@pytest.mark.parametrize("vowel", ["a", "i"])
def test_a_pulsing_glottis_equals_the_twin(vowel):
    """Equal slices whose gap opens and closes: the kernel's law is then exact, and so are the waves."""
    ways = airways(vowel, RHO, C, SECTION_TRAVEL_S)
    air, twin = ways.new_buffer(800.0), AirwaysTwin(ways)
    seen = []
    for n in range(1500):
        gap = max(8e-4 * np.sin(2 * np.pi * 150 * n * SECTION_TRAVEL_S), 0.0)
        if gap > 0:
            A, B, width = 0.5 * RHO / gap**2, 12 * 1.8e-5 * 2e-3 / gap**3, 0.015
            one = (np.array([A]), np.array([B]), np.array([width]))
            drop = max(abs(air[kernel.DROP]), kernel.SMALLEST_DROP_PA)
            kernel.advance_airways(air, 800.0, *law(*one, drop))
            twin.step(800.0, law_of(*one))
        else:
            kernel.advance_airways(air, 800.0, 0.0, 1.0)
            twin.step(800.0, lambda drop: 0.0)
        seen.append((air[kernel.FLOW], twin.flow, air[kernel.INLET], twin.inlet, air[kernel.OUTLET], twin.outlet))
    flow, flow_twin, inlet, inlet_twin, outlet, outlet_twin = np.array(seen).T
    assert flow.max() > 2e-4 and outlet.min() < -100
    assert np.abs(flow - flow_twin).max() < 1e-9 * flow.max()
    assert np.abs(inlet - inlet_twin).max() < 1e-6 and np.abs(outlet - outlet_twin).max() < 1e-6


def test_the_resistance_to_a_steady_flow_is_that_of_glottis_and_lungs():
    air = MALE.new_buffer(800.0)
    conductance, viscous = 1.2e-5, 0.1  # about 0.34 L/s under 800 Pa
    for _ in range(20000):
        kernel.advance_airways(air, 800.0, conductance, viscous)
    flow, drop = air[kernel.FLOW], air[kernel.DROP]
    assert air[kernel.INLET] == pytest.approx(800.0 - LUNG_RESISTANCE_PA_S_M3 * flow, rel=1e-6)
    assert abs(air[kernel.OUTLET]) < 1e-3
    assert (1 - viscous) * (flow / conductance) ** 2 + viscous * np.sqrt(drop) * flow / conductance == pytest.approx(
        drop, rel=1e-6
    )


@pytest.mark.kernel
@pytest.mark.parametrize("steps", [1, 4])
def test_without_lung_pressure_the_wave_energy_only_falls(steps):
    ways = airways("a", RHO, C, steps * SECTION_TRAVEL_S)
    air = ways.new_buffer(0.0)
    air[kernel.EXCESS_S] = air[kernel.EXCESS_V] = 0.0  # every step is passive; for the correction see the next test
    rng = np.random.default_rng(1)
    energies, views = [], []
    for tract, rows in zip((ways.subglottal, ways.supraglottal), ways.rows(air), strict=True):
        rows[:2] = 100 * rng.standard_normal((2, rows.shape[1]))
        # before the loss of the crossing a wave was larger by 1/α, so energy is counted before the loss
        views.append((rows, tract.transmission, np.array(tract.areas_m2)))
    for n in range(1000):
        energies.append(sum(float(np.sum(area * (rows[:2] / kept) ** 2)) for rows, kept, area in views))
        opening = 2e-5 * max(np.sin(n / 30), 0.0)
        kernel.advance_airways(air, 0.0, opening, 0.3 if opening > 0 else 1.0)
    energies = np.array(energies)
    memory = 1e-4 * energies[0]  # energy of the inertance at the lips is not in the sum
    assert (np.diff(energies) < memory).all() and energies[-1] < 2e-3 * energies[0]


@pytest.mark.parametrize("vowel", VOWELS)
def test_the_correction_for_steady_flow_leaves_every_airway_passive(vowel):
    """Its impedance minus the correction keeps a positive real part at every frequency."""
    ways = airways(vowel, RHO, C, DEFAULT_STEP_S)
    freqs = np.concatenate([np.geomspace(1e-2, 50, 300), np.linspace(50, 20000, 8000)])
    for tract, excess in zip((ways.subglottal, ways.supraglottal), ways.excess_resistance, strict=True):
        left = input_impedance(tract, freqs) - excess / (1 + 1j * freqs / STEADY_BELOW_HZ)
        assert excess > 0 and (left.real > 0).all()


def test_the_resonances_of_the_trachea_are_those_of_men():
    """Sg2 and Sg3 within 5 % of 1350 and 2200 Hz (Lulich et al. 2012); Sg1 is low without yielding walls."""
    frequency, bandwidth = closed_glottis_formants(subglottal_tract(), 3)
    assert frequency[1:] == pytest.approx([1350, 2200], rel=0.05) and 400 < frequency[0] < 550
    assert (bandwidth > 100).all() and (bandwidth < 250).all()


def test_sections_fit_the_step_and_too_short_a_step_is_refused():
    for step in (DEFAULT_STEP_S, DEFAULT_STEP_S / 3, 1e-5, SECTION_TRAVEL_S / 4):
        ways = airways("u", RHO, C, step)
        assert ways.substeps * ways.supraglottal.section_travel_s == pytest.approx(step, rel=1e-12)
        assert ways.substeps * ways.subglottal.section_travel_s == pytest.approx(step, rel=1e-12)
    with pytest.raises(ParameterError, match="too short for two-way coupling"):
        airways("u", RHO, C, 5e-7)


def test_a_smaller_larynx_has_smaller_airways():
    small = airways("a", RHO, C, DEFAULT_STEP_S, 0.8)
    assert small.supraglottal.areas_m2[0] == pytest.approx(0.64 * MALE.supraglottal.areas_m2[0], rel=0.02)
    assert len(small.supraglottal.areas_m2) == pytest.approx(0.8 * len(MALE.supraglottal.areas_m2), abs=1)


def of_one_shape(substeps):
    """Airways of several vowels and scales, whose areas differ but not their numbers of sections."""
    some = [("i", 0.764), ("e", 0.760), ("E", 0.754), ("V", 0.764), ("a", 0.756), ("O", 0.754)]
    return [airways(vowel, RHO, C, substeps * SECTION_TRAVEL_S, scale) for vowel, scale in some]


def random_tract(rng, sections, radiation):
    """Areas between 0.3 and 6 cm², each section another one."""
    return Tract(tuple(rng.uniform(3e-5, 6e-4, sections)), radiation=radiation)


def batch(ways, precision, seed=3):
    """One of ``ways`` for each fold, and lung pressure, conductance and viscous share at each step, (steps, folds)."""
    folds, steps = LANES[precision], 40 if UNCOMPILED else 2000
    rng = np.random.default_rng(seed)
    P_s = np.tile(rng.uniform(200, 2000, folds), (steps, 1))
    phase = rng.uniform(0.01, 0.06, folds) * np.arange(steps)[:, None]
    conductance = 2e-5 * np.maximum(np.sin(2 * np.pi * phase) + rng.uniform(-0.3, 0.3, (steps, folds)), 0)
    viscous = np.where(conductance > 0, rng.uniform(0, 1, (steps, folds)), 1.0)
    # alone and together start from the same numbers
    inputs = [one.astype(precision).astype(float) for one in (P_s, conductance, viscous)]
    return [ways[k % len(ways)] for k in range(folds)], inputs


def largest_difference(ways, inputs, precision):
    """Between airways together and alone, over the largest value: of flow, inlet, outlet and drop, over all folds."""
    found = together(ways, *inputs, precision)
    expected = np.stack([alone(one, *(x[:, k] for x in inputs)) for k, one in enumerate(ways)], axis=-1)
    assert (expected[:, 0].max(axis=0) > 2e-5).all()  # every glottis has opened
    return (np.abs(found - expected).max(axis=0) / np.abs(expected).max(axis=0)).max()


@pytest.mark.kernel
@pytest.mark.parametrize("precision, allowed", [("float64", 1e-12), ("float32", 1e-5)])
@pytest.mark.parametrize("substeps", [1, 5, 12])
def test_airways_side_by_side_equal_each_alone(precision, allowed, substeps):
    """Several vowels and scales in one batch, with all steps one by one, all together, and both."""
    assert largest_difference(*batch(of_one_shape(substeps), precision), precision) < allowed


@pytest.mark.kernel
@pytest.mark.parametrize("below, above", [(4, 4), (9, 5), (5, 17)])
def test_airways_of_any_shape_equal_each_alone(below, above):
    """Also with fewer sections than go together, and with a reflection at every junction below the glottis."""
    rng = np.random.default_rng(below)
    ways = [Airways(random_tract(rng, below, "lungs"), random_tract(rng, above, "piston"), 7) for _ in range(8)]
    assert largest_difference(*batch(ways, "float64"), "float64") < 1e-12


@pytest.mark.kernel
def test_the_airways_of_a_fold_do_not_depend_on_its_neighbours():
    ways, inputs = batch(of_one_shape(5), "float64")
    both = together(ways, *inputs)
    without = together([ways[-1]] * len(ways), *(np.repeat(x[:, -1:], len(ways), axis=1) for x in inputs))
    assert np.array_equal(both[..., -1], without[..., 0])


def test_airways_of_different_shapes_do_not_fit_one_batch():
    with pytest.raises(ParameterError, match=r"\(5, 78, 68\) and \(5, 78, 78\)"):
        Airways.new_buffers([(MALE, 800.0), (airways("u", RHO, C, DEFAULT_STEP_S), 800.0)])


MISSES = """
from tests.support.airways_march import march_kernel
from tests.physics.test_airways import batch, of_one_shape, together
for precision in ("float64", "float32"):
    ways, inputs = batch(of_one_shape(5), precision)
    together(ways, *inputs, precision)
    print(sum(march_kernel(precision).stats.cache_misses.values()))
"""


@pytest.mark.skipif(UNCOMPILED, reason="nothing is compiled")
def test_a_kernel_that_calls_the_airways_is_found_in_the_cache_by_a_second_process():
    for _ in range(2):
        done = subprocess.run(
            [sys.executable, "-c", MISSES], capture_output=True, text=True, check=True, timeout=300, cwd=ROOT
        )
    assert done.stdout.split() == ["0", "0"]
