"""The stepped tube: equal to its twin, passive, causal, and exact where a solution is known."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.support.tract_twin import stepped_twin
from vfcore.airways.tract import Tract, stepped, vowel_tract
from vfcore.errors import ParameterError
from vfcore.kernels.tract import FINITE, advance_tract

AREAS = st.lists(st.floats(1e-6, 5e-3), min_size=4, max_size=80)


@given(areas=AREAS, seed=st.integers(0, 999), radiation=st.sampled_from(("piston", "open")))
@settings(max_examples=25, deadline=None)
def test_stepped_tube_equals_its_twin(areas, seed, radiation):
    flow = np.random.default_rng(seed).standard_normal(4 * len(areas)) * 1e-3
    pressure, mouth = stepped(flow, Tract(areas, radiation=radiation))
    twin_pressure, twin_mouth = stepped_twin(flow, areas, 0.0025, open_end=radiation == "open")
    scale = 1.14 * 350 / min(areas) * np.abs(flow).max()
    np.testing.assert_allclose(pressure, twin_pressure, rtol=0, atol=1e-11 * scale)
    np.testing.assert_allclose(mouth, twin_mouth, rtol=0, atol=1e-11 * scale * areas[-1] / (1.14 * 350))
    assert np.abs(twin_mouth).max() > 0


@given(areas=AREAS, seed=st.integers(0, 999), attenuation=st.sampled_from((0.0, 3.8e-3)))
@settings(max_examples=40, deadline=None)
def test_wave_energy_never_grows_without_flow(areas, seed, attenuation):
    rng = np.random.default_rng(seed)
    tract = Tract(areas, attenuation=attenuation)
    forward, backward = rng.standard_normal((2, len(areas)))
    memory, silence, impedance = np.zeros(1), np.zeros(1), tract.impedance_pa_s_m3
    inertance = tract.radiation_resistance_inertance[1]
    # A trapezoidal inertance stores τ a²/(4·2L/τ) with the wave a = p + (2L/τ) i_L, i_L = ∫p dt/L.
    integral, pressure_before = 0.0, 0.0
    energies = []
    for _ in range(3 * len(areas)):
        tubes = np.sum((forward**2 + backward**2) / impedance) * tract.section_travel_s
        stored = (tract.section_travel_s * pressure_before + 2 * integral) ** 2 / (8 * inertance)
        energies.append(tubes + stored)
        pressure, mouth = np.zeros(1), np.zeros(1)
        status = advance_tract(
            silence,
            tract.transmission,
            tract.reflection,
            impedance[0],
            impedance[-1],
            tract.lip_reflection,
            forward,
            backward,
            memory,
            pressure,
            mouth,
        )
        assert status == FINITE
        integral += tract.section_travel_s / 2 * (pressure[0] + pressure_before)
        pressure_before = pressure[0]
    assert np.all(np.diff(energies) <= 1e-12 * energies[0])
    assert energies[-1] < energies[0]


def test_sound_leaves_after_exactly_the_tract_length():
    tract = vowel_tract("a")
    impulse = np.zeros(200)
    impulse[0] = 1.0
    pressure, mouth = stepped(impulse, tract)
    assert not pressure[:68].any()
    assert not mouth[:68].any()
    # the first arrival has met every junction once: Z_0 Π α_i Π (1 + r_i), then the lips
    areas = np.array(tract.areas_m2)
    crossing = np.prod(1 - 3.8e-3 * 0.0025 / np.sqrt(areas)) * np.prod(2 * areas[:-1] / (areas[:-1] + areas[1:]))
    arriving = 1.14 * 350 / areas[0] * crossing
    incident = (pressure[68] + mouth[68] * 1.14 * 350 / areas[-1]) / 2
    assert incident == pytest.approx(arriving, rel=1e-12)


def test_a_steady_flow_is_unchanged_and_has_no_pressure_at_the_lips():
    tract = Tract([2e-4] * 20 + [9e-4] * 30, attenuation=0.0)  # a wide mouth: the onset dies out by radiation alone
    pressure, mouth = stepped(np.full(50_000, 2e-4), tract)
    assert np.abs(mouth[-1000:] / 2e-4 - 1).max() < 1e-6
    assert np.abs(pressure[-1000:]).max() < 1e-6 * np.abs(pressure).max()


def test_open_end_has_no_pressure_and_a_uniform_tube_inverts_the_wave():
    tract = Tract([3e-4] * 10, radiation="open", attenuation=0.0)
    impulse = np.zeros(61)
    impulse[0] = 1.0
    pressure, mouth = stepped(impulse, tract)
    expected = np.zeros(61)
    expected[[10, 30, 50]] = [2.0, -2.0, 2.0]  # doubled at the open end, inverted there, returned by the glottis
    assert not pressure.any()
    np.testing.assert_allclose(mouth, expected, atol=1e-14)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_flow_that_is_not_finite_is_refused(value):
    flow = np.zeros(50)
    flow[20] = value
    with pytest.raises(ParameterError, match="not finite"):
        stepped(flow, vowel_tract("a"))


def test_a_flow_that_is_not_a_waveform_is_refused():
    with pytest.raises(ParameterError, match="not a waveform"):
        stepped(np.zeros((3, 3)), vowel_tract("a"))


@pytest.mark.parametrize(
    "change, path",
    [
        ({"areas_m2": (3e-4,) * 3}, "tract.areas_m2 (sections)"),
        ({"areas_m2": (3e-4, 3e-4, 0.0, 3e-4)}, "tract.areas_m2[2]"),
        ({"areas_m2": (3e-4, np.nan, 3e-4, 3e-4)}, "tract.areas_m2[1]"),
        ({"section_length_m": 0.5}, "tract.section_length_m"),
        ({"density_kg_m3": -1.0}, "tract.density_kg_m3"),
        ({"sound_speed_m_s": 0.0}, "tract.sound_speed_m_s"),
        ({"attenuation": 1.0}, "tract.attenuation"),
        ({"radiation": "flanged"}, "tract.radiation"),
    ],
)
def test_an_invalid_tract_is_refused_by_name(change, path):
    with pytest.raises(ParameterError) as caught:
        Tract(**({"areas_m2": (3e-4,) * 10} | change))
    assert caught.value.path == path
