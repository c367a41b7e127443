"""Impulse response and radiation: the same sound as the stepped tube, at any time step."""

import numpy as np
import pytest

from tests.support.tract_twin import chain_response
from vfcore.airways import impulse_response as module
from vfcore.airways.impulse_response import FAR_DISTANCE_M, impulse_response, radiate, radiate_each
from vfcore.airways.tract import Tract, stepped, vowel_tract
from vfcore.errors import ParameterError
from vfcore.spec.simulation import DEFAULT_STEP_S, PAPER_STEP_S

A = vowel_tract("a")
TRAVEL = A.section_travel_s


def some_flow(count, seed=0):
    return np.random.default_rng(seed).random(count) * 1e-3


def assert_same(values, expected, relative=1e-9):
    np.testing.assert_allclose(values, expected, rtol=0, atol=relative * np.abs(expected).max())


@pytest.mark.parametrize("vowel", ["a", "i", "u"])
def test_equals_the_stepped_tube_over_a_run_longer_than_response_and_block(vowel):
    tract = vowel_tract(vowel)
    flow = some_flow(150_000)
    assert flow.size > 2 * module.LONGEST_BLOCK
    assert flow.size > 4 * impulse_response(tract).lip_pressure_pa.size
    sound = radiate(flow, tract.section_travel_s, tract)
    pressure, mouth = stepped(flow, tract)
    assert_same(sound.lip_pressure_pa, pressure)
    assert_same(sound.mouth_flow_m3_s, mouth)


def smooth(flow, step, half_width=6):
    """The flow, 0 before its start, interpolated by a sinc in a Kaiser window."""
    flow = np.concatenate([np.zeros(2 * half_width), flow, np.zeros(2 * half_width)])

    def at(instants):
        place = np.asarray(instants) / step + 2 * half_width
        value, weights = np.zeros(place.shape), np.zeros(place.shape)
        for offset in range(-half_width, half_width + 1):
            sample = np.round(place).astype(int) + offset
            away = place - sample
            window = np.where(np.abs(away) < half_width, np.i0(10 * np.sqrt(np.abs(1 - (away / half_width) ** 2))), 0)
            weight = np.sinc(away) * window
            value += weight * flow[np.clip(sample, 0, flow.size - 1)]
            weights += weight
        return value / weights

    return at


def test_default_step_equals_the_stepped_tube_fed_with_a_smooth_flow():
    assert pytest.approx(5 * TRAVEL, rel=1e-12) == DEFAULT_STEP_S
    flow = some_flow(20_000)
    fine = smooth(flow, DEFAULT_STEP_S)(np.arange(-30, 100_000) * TRAVEL)
    pressure, mouth = stepped(fine, A)
    sound = radiate(flow, DEFAULT_STEP_S, A)
    assert_same(sound.lip_pressure_pa, pressure[30::5])
    assert_same(sound.mouth_flow_m3_s, mouth[30::5])


def test_paper_step_equals_four_interleaved_tubes():
    assert pytest.approx(TRAVEL / 4, rel=1e-12) == PAPER_STEP_S
    flow = some_flow(100_000)
    expected = np.empty_like(flow)
    for phase in range(4):
        expected[phase::4] = stepped(flow[phase::4], A).lip_pressure_pa
    assert_same(radiate(flow, PAPER_STEP_S, A).lip_pressure_pa, expected)


@pytest.mark.parametrize("ratio", [3.7, 0.61, 1 / 3, 14.0, 17.0])
def test_any_step_equals_the_tube_stepped_back_from_that_instant(ratio):
    flow = some_flow(9000)
    step = ratio * TRAVEL
    sound = radiate(flow, step, A)
    # No further ahead than sound travels, less the two sections used by the derivative of the flow.
    between = smooth(flow, step, min(6, int(66 / ratio) + 1))
    for m in (100, 2345, 8990):
        back = np.arange(-2, int((m + 9) * ratio))[::-1] * TRAVEL  # the tube's clock, to two sections beyond m
        instants = m * step - back
        heard = stepped(np.where(instants < -6 * step, 0.0, between(instants)), A)
        assert abs(sound.lip_pressure_pa[m] - heard.lip_pressure_pa[-3]) < 1e-9 * np.abs(sound.lip_pressure_pa).max()
        rate = np.array([1, -8, 0, 8, -1]) / 12 @ heard.mouth_flow_m3_s[-5:] / TRAVEL
        far = 1.14 / (4 * np.pi * FAR_DISTANCE_M) * rate
        assert abs(sound.far_pressure_pa[m] - far) < 1e-9 * np.abs(sound.far_pressure_pa).max()


def pulses(time):
    """Voice-like pulses (Rosenberg 1971) of 150 Hz, m³/s."""
    phase = (time * 150) % 1
    opening = 0.5 - 0.5 * np.cos(np.pi * phase / 0.3)
    closing = np.cos(np.pi / 2 * (phase - 0.3) / 0.17)
    return 1e-3 * np.where(phase < 0.3, opening, np.where(phase < 0.47, closing, 0.0))


def test_default_step_keeps_the_paper_step_s_spectrum_to_10_khz():
    levels = []
    for step in (PAPER_STEP_S, DEFAULT_STEP_S):
        count = round(0.4 / step)
        heard = radiate(pulses(np.arange(count) * step), step, A).lip_pressure_pa[count // 2 :]
        power = np.abs(np.fft.rfft(heard * np.blackman(heard.size)) * step) ** 2
        freqs = np.fft.rfftfreq(heard.size, step)
        levels.append([10 * np.log10(power[(freqs >= f) & (freqs < f + 1000)].sum()) for f in range(0, 10_000, 1000)])
    assert np.abs(np.subtract(*levels)).max() < 0.1


def test_response_is_the_chain_matrix_calculation():
    freqs = np.array([50.0, 300, 671, 947, 1500, 2961, 4000, 8000, 15_000, 33_000])
    response = impulse_response(A).lip_pressure_pa
    steps = np.arange(response.size)
    spectrum = np.array([np.sum(response * np.exp(-2j * np.pi * f * TRAVEL * steps)) for f in freqs])
    exact = chain_response(freqs, A.areas_m2, A.section_length_m, warped=True)
    assert np.abs(spectrum / exact - 1).max() < 1e-7
    # and the bilinear transform does not matter at audible voice frequencies
    analogue = chain_response(freqs[:8], A.areas_m2, A.section_length_m)
    assert np.abs(20 * np.log10(np.abs(spectrum[:8] / analogue))).max() < 0.1


@pytest.mark.parametrize("vowel", ["a", "i", "u"])
def test_the_truncation_of_the_response_is_negligible(vowel):
    tract = vowel_tract(vowel)
    kept = impulse_response(tract).lip_pressure_pa
    impulse = np.zeros(3 * kept.size)
    impulse[0] = 1.0
    whole = stepped(impulse, tract).lip_pressure_pa
    assert np.array_equal(whole[: kept.size], kept)
    assert np.sum(whole[kept.size :] ** 2) < 1e-18 * np.sum(whole**2)


@pytest.mark.parametrize("step, relative", [(TRAVEL, 1e-5), (DEFAULT_STEP_S, 1e-3)])
def test_far_pressure_is_a_simple_source_driven_by_the_mouth_flow(step, relative):
    frequency = 1000.0
    time = np.arange(round(0.8 / step)) * step
    sound = radiate(np.sin(2 * np.pi * frequency * time) * 1e-4, step, A)
    steady = time > 0.3
    tone = np.exp(-2j * np.pi * frequency * time[steady]) * np.hanning(steady.sum())
    mouth, far = (np.sum(x[steady] * tone) for x in (sound.mouth_flow_m3_s, sound.far_pressure_pa))
    assert FAR_DISTANCE_M == 0.3  # the clinical distance, 30 cm
    assert far / mouth == pytest.approx(1.14 / (4 * np.pi * 0.3) * 2j * np.pi * frequency, rel=relative)


def test_a_start_with_flow_stays_a_jump():
    sound = radiate(np.full(400, 1e-4), TRAVEL, A)
    assert not np.abs(sound.mouth_flow_m3_s[:68]).max() > 1e-15
    assert sound.mouth_flow_m3_s[68] > 1e-5


def test_a_short_run_is_the_beginning_of_a_long_one():
    flow = some_flow(5000)
    short = radiate(flow[:300], DEFAULT_STEP_S, A)
    long = radiate(flow, DEFAULT_STEP_S, A)
    for part, whole in zip(short, long, strict=True):
        assert part.shape == (300,)
        np.testing.assert_allclose(part, whole[:300], rtol=0, atol=1e-12 * np.abs(whole).max())


def test_the_response_depends_on_air_and_step():
    flow = some_flow(3000)
    first = radiate(flow, DEFAULT_STEP_S, A).lip_pressure_pa.copy()
    lighter = radiate(flow, DEFAULT_STEP_S, vowel_tract("a", 0.57, 350.0)).lip_pressure_pa
    coarser = radiate(flow, 2 * DEFAULT_STEP_S, A).lip_pressure_pa
    assert_same(lighter, first / 2)  # pressure is proportional to density, flow is not
    assert np.abs(coarser - first).max() > 0.1 * np.abs(first).max()
    assert np.array_equal(radiate(flow, DEFAULT_STEP_S, A).lip_pressure_pa, first)


def test_several_flows_in_one_call_sound_as_each_alone():
    """Equal to the bit in double precision; within a few times rounding, 6e-8 of the largest value, in single."""
    flows = np.stack([some_flow(3000), some_flow(3000)[::-1], 2e-4 + 0.5 * some_flow(3000)])
    alone = [radiate(flow, DEFAULT_STEP_S, A, first=1000) for flow in flows]
    double = radiate_each(flows, DEFAULT_STEP_S, A, first=1000)
    single = radiate_each(flows.astype(np.float32), DEFAULT_STEP_S, A, first=1000)
    for name in double._fields:
        expected = np.stack([getattr(sound, name) for sound in alone])
        assert np.array_equal(getattr(double, name), expected), name
        assert getattr(single, name).dtype == np.float32
        np.testing.assert_allclose(getattr(single, name), expected, rtol=0, atol=1e-6 * np.abs(expected).max())


def test_a_tube_that_never_stops_ringing_is_refused():
    with pytest.raises(ParameterError, match="rings without end"):
        impulse_response(Tract([3e-4] * 70, radiation="open", attenuation=0.0))


@pytest.mark.parametrize(
    "flow, step, path",
    [
        (np.array([0.0, np.nan]), DEFAULT_STEP_S, "flow_m3_s"),
        (np.zeros((2, 2)), DEFAULT_STEP_S, "flow_m3_s"),
        (np.zeros(0), DEFAULT_STEP_S, "flow_m3_s"),
        (np.zeros(10), 0.0, "time_step_s"),
        (np.zeros(10), 69 * TRAVEL, "time_step_s"),
        (np.zeros(10), np.nan, "time_step_s"),
    ],
)
def test_unusable_input_is_refused_by_name(flow, step, path):
    with pytest.raises(ParameterError) as caught:
        radiate(flow, step, A)
    assert caught.value.path == path
