"""Resonances with closed glottis: published values, exact tubes, an independent calculation, eleven vowels."""

from functools import cache

import numpy as np
import pytest

from tests.support.tract_twin import chain_response
from vfcore.airways.resonances import closed_glottis_formants, poles, transfer_function
from vfcore.airways.tract import Tract, vowel_tract
from vfcore.errors import ParameterError
from vfcore.spec.area_functions import area_function
from vfcore.spec.simulation import VOWELS


@cache
def formants(vowel):
    return closed_glottis_formants(vowel_tract(vowel)).frequency_hz


def test_story_a_at_its_own_sections():
    story = area_function("a")
    tract = Tract(story.areas_m2, story.section_length_m)
    np.testing.assert_allclose(closed_glottis_formants(tract).frequency_hz, [668, 936, 2953, 3972], rtol=0.01)


def test_story_a_in_sections_of_a_quarter_centimetre():
    np.testing.assert_allclose(formants("a"), [674, 945, 2965, 3993], rtol=0.01)


@pytest.mark.parametrize("attenuation", [0.0, 3.8e-3])
def test_a_uniform_open_tube_has_odd_quarter_waves(attenuation):
    tract = Tract([3e-4] * 70, radiation="open", attenuation=attenuation)
    found = closed_glottis_formants(tract, 6)
    np.testing.assert_allclose(found.frequency_hz, 500 * np.array([1, 3, 5, 7, 9, 11]), rtol=0, atol=1e-6)
    decay_per_s = -np.log(1 - attenuation * 0.0025 / np.sqrt(3e-4)) * 350 / 0.0025
    np.testing.assert_allclose(found.bandwidth_hz, decay_per_s / np.pi, rtol=0, atol=1e-6)


def test_two_tubes_resonate_at_zero_total_impedance():
    # glottal half 1 cm², oral half 7 cm², 8.75 cm each, lossless and open: tan² kl = A_oral/A_glottal
    tract = Tract([1e-4] * 35 + [7e-4] * 35, radiation="open", attenuation=0.0)
    first = 350 / (2 * np.pi * 0.0875) * np.arctan(np.sqrt(7))
    second = 350 / (2 * np.pi * 0.0875) * (np.pi - np.arctan(np.sqrt(7)))
    found = closed_glottis_formants(tract, 2).frequency_hz
    assert found == pytest.approx([first, second], rel=1e-9)


def test_transfer_function_equals_an_independent_chain_matrix_product():
    tract = vowel_tract("i")
    freqs = np.array([[20.0, 260, 1000], [2135, 7777, 20_000]])
    found = transfer_function(tract, freqs)
    expected = chain_response(freqs.ravel(), tract.areas_m2, tract.section_length_m, warped=True).reshape(2, 3)
    np.testing.assert_allclose(found.lip_pressure, expected, rtol=1e-10)
    assert abs(transfer_function(tract, 0.0).lip_pressure) == 0


@pytest.mark.parametrize("vowel", ["i", "AE", "u"])
def test_formants_and_bandwidths_are_the_peaks_of_the_response(vowel):
    tract = vowel_tract(vowel)
    found = closed_glottis_formants(tract, 3)
    for frequency, bandwidth in zip(*found, strict=True):
        near = frequency + np.linspace(-2, 2, 801) * bandwidth
        level = np.abs(chain_response(near, tract.areas_m2, tract.section_length_m))
        assert near[level.argmax()] == pytest.approx(frequency, abs=0.15 * bandwidth)
        above = near[level >= level.max() / np.sqrt(2)]
        assert above[-1] - above[0] == pytest.approx(bandwidth, rel=0.1)


def test_formants_follow_the_speed_of_sound():
    fast = closed_glottis_formants(vowel_tract("a", 1.14, 700.0)).frequency_hz
    np.testing.assert_allclose(fast, 2 * formants("a"), rtol=1e-9)


def test_every_vowel_is_damped():
    assert all(np.abs(poles(vowel_tract(vowel))).max() < 1 for vowel in VOWELS)


def test_vowels_have_the_expected_formants():
    """Qualitative: the vowel quadrilateral, and the bounds of a man's formants."""
    f1 = {vowel: formants(vowel)[0] for vowel in VOWELS}
    f2 = {vowel: formants(vowel)[1] for vowel in VOWELS}
    assert f1["i"] < 400 and f2["i"] > 1900
    assert f1["u"] < 400 and f2["u"] < 1100
    assert f1["a"] > 600 and f2["a"] < 1200
    assert f1["i"] < f1["I"] < f1["e"] < f1["E"] < f1["AE"]  # jaw and tongue are lower
    assert f2["i"] > f2["I"] > f2["e"] > max(f2["E"], f2["AE"]) > f2["a"]  # tongue is further back
    assert all(200 < f1[vowel] < 900 and f1[vowel] < f2[vowel] < 2600 for vowel in VOWELS)
    assert all(2000 < formants(vowel)[2] < 3500 for vowel in VOWELS)


def test_a_request_for_too_many_resonances_is_refused():
    with pytest.raises(ParameterError, match="resonances"):
        closed_glottis_formants(vowel_tract("a"), 400)
