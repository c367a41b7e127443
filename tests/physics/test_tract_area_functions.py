"""Area functions: the eleven published vowels, and resampling that keeps the shape of the tract."""

import numpy as np
import pytest

from vfcore.airways.tract import vowel_tract
from vfcore.errors import ParameterError
from vfcore.spec.area_functions import AreaFunction, area_function, resampled
from vfcore.spec.simulation import VOWELS

# Story (2008): length of the tract in cm, 44 sections
LENGTHS_CM = {
    "i": 16.90, "I": 16.54, "e": 16.98, "E": 17.29, "AE": 16.10, "V": 17.16,
    "a": 17.07, "O": 17.38, "o": 18.35, "U": 19.36, "u": 19.58,
}  # fmt: skip


@pytest.mark.parametrize("vowel", VOWELS)
def test_every_vowel_loads_with_its_length_and_source(vowel):
    function = area_function(vowel)
    assert len(function.areas_m2) == 44
    assert function.length_m * 100 == pytest.approx(LENGTHS_CM[vowel], abs=0.006)
    assert all(1e-6 < area < 2e-3 for area in function.areas_m2)
    assert "Story" in function.source and "2008" in function.source
    assert function.ipa


def test_a_is_the_open_back_vowel_of_story():
    areas = area_function("a").areas_m2
    assert area_function("a").ipa == "ɑ"
    assert areas[0] == pytest.approx(0.56e-4) and areas[-1] == pytest.approx(4.72e-4)
    assert np.argmax(areas) > 22  # the wide cavity of an open back vowel is the mouth
    assert np.argmax(area_function("i").areas_m2) < 22


@pytest.mark.parametrize("vowel", VOWELS)
def test_resampling_keeps_length_volume_and_shape(vowel):
    old = area_function(vowel)
    new = resampled(old)
    assert new.section_length_m == 0.0025
    assert abs(new.length_m - old.length_m) <= 0.00125 + 1e-12
    volume_new = sum(new.areas_m2) * new.section_length_m
    volume_old = sum(old.areas_m2) * old.section_length_m
    assert volume_new == pytest.approx(volume_old, rel=0.02)
    assert min(new.areas_m2) >= min(old.areas_m2) and max(new.areas_m2) <= max(old.areas_m2)


def test_resampling_a_gives_68_sections():
    new = resampled(area_function("a"))
    assert len(new.areas_m2) == 68
    assert "68 sections of 0.25 cm" in new.source
    assert vowel_tract("a").section_travel_s == pytest.approx(7.142857e-6, rel=1e-7)


def test_resampling_is_exact_for_a_cone_and_for_its_own_sections():
    cone = AreaFunction(0.004, tuple(1e-4 + 1e-2 * (np.arange(40) + 0.5) * 0.004), "made up")
    new = resampled(cone, 0.0025)
    centres = (np.arange(64) + 0.5) * 0.0025
    inside = (centres > 0.002) & (centres < 0.158)
    np.testing.assert_allclose(np.array(new.areas_m2)[inside], 1e-4 + 1e-2 * centres[inside], rtol=1e-12)
    np.testing.assert_allclose(resampled(cone, 0.004).areas_m2, cone.areas_m2, rtol=1e-12)


@pytest.mark.parametrize("vowel", ["A", "/A/", "y", "", None])
def test_an_unknown_vowel_is_refused_and_the_known_ones_are_named(vowel):
    with pytest.raises(ParameterError, match="AE") as caught:
        area_function(vowel)
    assert caught.value.path == "vowel"


@pytest.mark.parametrize("length", [0.0, -0.0025, np.nan, 0.3])
def test_an_unusable_section_length_is_refused(length):
    with pytest.raises(ParameterError, match="section_length_m"):
        resampled(area_function("a"), length)
