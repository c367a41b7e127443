"""The airway below the glottis: trachea and first bronchi of Weibel (1963), ended by the lungs.

Generations 0 to 3 of Weibel's model A, the parallel tubes of a generation as one tube of their total area (Ishizaka,
Matsudaira & Kaneko 1976; Titze 2006). They are 19.4 cm long; the effective acoustic length of the subglottal tract of
men is 19.5 cm (Hanna, Smith & Wolfe 2018). Beyond, the total area flares and the tract acts as open. It ends in a
resistance: a wave returns as −0.8 of itself (the lung end of Story's and Titze's simulations), so that the lung
pressure reaches a glottis at rest and a steady flow loses little of it. Loss per crossing 11.2e-3 δ/√A, about three
times that of the vocal tract (Titze 2006, as used with Alzamendi et al. 2022).

Resonances with closed glottis: 430, 1335 and 2230 Hz, bandwidths about 150 Hz. In men about 550, 1350 and 2200 Hz are
measured (Lulich et al. 2012, approximate): the first is higher because the walls yield, which is not modelled.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import pi

import numpy as np

from vfcore.airways.tract import Tract
from vfcore.fold.constants import FoldConstants
from vfcore.spec.area_functions import SECTION_LENGTH_M, SECTION_LIMITS_M
from vfcore.spec.fields import check_number

SUBGLOTTAL_ATTENUATION = 11.2e-3
_AIR = FoldConstants()


@dataclass(frozen=True, slots=True)
class Generation:
    """One generation of the bronchial tree: length and diameter of a tube, m; how many there are."""

    length_m: float
    diameter_m: float
    tubes: int

    @property
    def area_m2(self) -> float:
        """Total section of the tubes, m²."""
        return self.tubes * pi / 4 * self.diameter_m**2


WEIBEL = (
    Generation(0.1200, 0.0180, 1),
    Generation(0.0476, 0.0122, 2),
    Generation(0.0190, 0.0083, 4),
    Generation(0.0076, 0.0056, 8),
)


@lru_cache(maxsize=64)
def subglottal_tract(
    section_length_m: float = SECTION_LENGTH_M,
    density_kg_m3: float = _AIR.rho_a_kg_m3,
    sound_speed_m_s: float = _AIR.c_a_m_s,
    scale: float = 1.0,
) -> Tract:
    """Tubes from the glottis to the lungs, all lengths and diameters times ``scale``.

    The number of sections is rounded; a section has the area found at its centre.
    """
    check_number("section_length_m", section_length_m, *SECTION_LIMITS_M, "m")
    ends = np.cumsum([generation.length_m for generation in WEIBEL]) * scale
    centres = (np.arange(max(round(ends[-1] / section_length_m), 4)) + 0.5) * section_length_m
    place = np.minimum(np.searchsorted(ends, centres, side="right"), len(WEIBEL) - 1)
    areas = tuple(WEIBEL[k].area_m2 * scale**2 for k in place)
    return Tract(areas, section_length_m, density_kg_m3, sound_speed_m_s, "lungs", SUBGLOTTAL_ATTENUATION)
