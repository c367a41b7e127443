"""Vocal tract area functions of Story (2008): cross-sections from the glottis to the lips, one per vowel."""

import json
from dataclasses import dataclass, replace
from functools import lru_cache
from importlib.resources import files

import numpy as np

from vfcore.errors import ParameterError
from vfcore.spec.fields import check_number
from vfcore.spec.simulation import VOWELS

SECTION_LENGTH_M = 0.0025  # the paper's time step is a quarter of this section's travel time
SECTION_LIMITS_M = (2.5e-4, 2e-2)
_CM2 = 1e-4
_STORED_NAME = {vowel: f"/{vowel}/" for vowel in VOWELS} | {"a": "/A/"}


@dataclass(frozen=True, slots=True)
class AreaFunction:
    """Areas of equally long tract sections, glottis first: section length, m; areas, m²; source; IPA symbol."""

    section_length_m: float
    areas_m2: tuple[float, ...]
    source: str
    ipa: str = ""

    @property
    def length_m(self) -> float:
        """Length of the tract, glottis to lips, m."""
        return self.section_length_m * len(self.areas_m2)


@lru_cache(maxsize=1)
def _stored() -> dict:
    return json.loads(files("vfcore.spec.data").joinpath("story2008_area_functions.json").read_text(encoding="utf-8"))


def area_function(vowel: str) -> AreaFunction:
    """The published 44-section area function of one of ``vfcore.spec.simulation.VOWELS``; ParameterError for any
    other.
    """
    if vowel not in _STORED_NAME:
        raise ParameterError("vowel", f"{vowel!r} is not known", " | ".join(VOWELS))
    stored = _stored()
    entry = stored["vowels"][_STORED_NAME[vowel]]
    areas = tuple(area * _CM2 for area in entry["areas_cm2"])
    return AreaFunction(entry["section_length_m"], areas, stored["source"], entry["ipa"])


def scaled(function: AreaFunction, scale: float) -> AreaFunction:
    """The tract with all lengths and diameters times ``scale``; the same tract for 1."""
    if scale == 1.0:
        return function
    areas = tuple(area * scale**2 for area in function.areas_m2)
    return replace(function, section_length_m=function.section_length_m * scale, areas_m2=areas)


def resampled(function: AreaFunction, section_length_m: float = SECTION_LENGTH_M) -> AreaFunction:
    """The same tract in sections of another length, so that a time step can equal the travel time of a section.

    The number of sections is the tract length over the new section length, rounded. Areas are interpolated linearly
    between the old section centres, at the new centres' own distance from the glottis. Nothing is stretched; the area
    is constant beyond the first and last old centre. Rounding to whole sections changes the length by at most half a
    new section: /a/ goes from 17.07 to 17.00 cm, and its first four resonances move up by .7, 1.0, .4 and .5 %.
    """
    check_number("section_length_m", section_length_m, *SECTION_LIMITS_M, "m")
    count = round(function.length_m / section_length_m)
    old_centres = (np.arange(len(function.areas_m2)) + 0.5) * function.section_length_m
    new_centres = (np.arange(count) + 0.5) * section_length_m
    areas = np.interp(new_centres, old_centres, function.areas_m2)
    source = f"{function.source}; resampled to {count} sections of {section_length_m * 100:g} cm"
    return AreaFunction(float(section_length_m), tuple(areas.tolist()), source, function.ipa)
