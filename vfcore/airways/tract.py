"""A vocal tract as equal tubes, its end at the lips, and its step-by-step simulation.

Radiation from the lips (Flanagan 1972, piston in a baffle) is a resistance and an inertance in parallel,

    R = 128 Z/(9π²),   L = 8 a Z/(3π c),   Z = ρc/A_end,   a = √(A_end/π),   Z_rad(s) = s L R/(R + s L).

The bilinear transform s → (2/τ)(1 − z⁻¹)/(1 + z⁻¹), τ the travel time of one section, keeps a positive-real
impedance positive real, so the reflection stays at or below one at every frequency and the tract stays passive.
With γ = 2L/(τZ) and κ = 2L/(τR) the reflection (Z_rad − Z)/(Z_rad + Z) becomes

    r(z) = (β_0 + β_1 z⁻¹)/(1 + a_1 z⁻¹)
    β_0 = (γ − 1 − κ)/D,   β_1 = (κ − 1 − γ)/D,   a_1 = (1 − γ − κ)/D,   D = 1 + γ + κ

(at 0 Hz −1: no pressure at the lips; |a_1| < 1). The transform's warping of the frequency axis,
(2/τ) tan(ωτ/2), is 1.1 % at 8 kHz and touches the radiation only. The ideal open end is r = −1.
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from vfcore.errors import ParameterError
from vfcore.fold.constants import FoldConstants
from vfcore.kernels.tract import FINITE, advance_tract
from vfcore.spec.area_functions import SECTION_LENGTH_M, SECTION_LIMITS_M, area_function, resampled, scaled
from vfcore.spec.fields import check_number

ATTENUATION = 3.8e-3  # dimensionless; Titze (2006), section 6.4, as used with Alzamendi et al. (2022)
RADIATIONS = ("piston", "open", "lungs")
LUNG_REFLECTION = -0.8  # Story & Titze (1995), as in their later simulations
AREA_LIMITS_M2 = (1e-7, 1e-1)
SECTION_COUNT_LIMITS = (4, 2000)
_AIR = FoldConstants()


class LipOutput(NamedTuple):
    """What leaves the tract: pressure at the lips, Pa, and volume flow through them, m³/s; both of one shape."""

    lip_pressure_pa: np.ndarray
    mouth_flow_m3_s: np.ndarray


@dataclass(frozen=True, slots=True)
class Tract:
    """Tubes of equal length from the glottis to the lips, in SI units.

    ``radiation``: what ends it: "piston" (the docstring above), "open" (ideal open end, zero lip pressure) or "lungs"
    (a resistance, for the airway below the glottis).
    ``attenuation``: loss per tube and crossing is ``attenuation`` × section length / √area. ParameterError for
    values outside the limits of this module.
    """

    areas_m2: tuple[float, ...]
    section_length_m: float = SECTION_LENGTH_M
    density_kg_m3: float = _AIR.rho_a_kg_m3
    sound_speed_m_s: float = _AIR.c_a_m_s
    radiation: str = "piston"
    attenuation: float = ATTENUATION

    def __post_init__(self):
        object.__setattr__(self, "areas_m2", tuple(float(area) for area in self.areas_m2))
        check_number("tract.areas_m2 (sections)", len(self.areas_m2), *SECTION_COUNT_LIMITS)
        for index, area in enumerate(self.areas_m2):
            check_number(f"tract.areas_m2[{index}]", area, *AREA_LIMITS_M2, "m²")
        check_number("tract.section_length_m", self.section_length_m, *SECTION_LIMITS_M, "m")
        check_number("tract.density_kg_m3", self.density_kg_m3, 0.1, 10, "kg/m³")
        check_number("tract.sound_speed_m_s", self.sound_speed_m_s, 100, 1500, "m/s")
        check_number("tract.attenuation", self.attenuation, 0, 2e-2)
        if self.radiation not in RADIATIONS:
            raise ParameterError("tract.radiation", f"{self.radiation!r} is not known", " | ".join(RADIATIONS))

    @property
    def section_travel_s(self) -> float:
        """Time a wave takes through one section: the tract's own time step, s."""
        return self.section_length_m / self.sound_speed_m_s

    @property
    def impedance_pa_s_m3(self) -> np.ndarray:
        """Characteristic impedance ρc/A of each section, Pa·s/m³, shape (sections,)."""
        return self.density_kg_m3 * self.sound_speed_m_s / np.array(self.areas_m2)

    @property
    def transmission(self) -> np.ndarray:
        """Fraction of a wave's pressure that is left after one crossing of each section, shape (sections,)."""
        return 1.0 - self.attenuation * self.section_length_m / np.sqrt(self.areas_m2)

    @property
    def reflection(self) -> np.ndarray:
        """Reflection coefficient of each junction, seen from the glottis, shape (sections − 1,)."""
        areas = np.array(self.areas_m2)
        return (areas[:-1] - areas[1:]) / (areas[:-1] + areas[1:])

    @property
    def radiation_resistance_inertance(self) -> tuple[float, float]:
        """R, Pa·s/m³, and L, Pa·s²/m³, of the piston at the lips."""
        impedance = self.impedance_pa_s_m3[-1]
        radius = math.sqrt(self.areas_m2[-1] / math.pi)
        return 128 * impedance / (9 * math.pi**2), 8 * radius * impedance / (3 * math.pi * self.sound_speed_m_s)

    @property
    def lip_reflection(self) -> np.ndarray:
        """β_0, β_1, a_1 of the lip reflection filter."""
        if self.radiation == "open":
            return np.array([-1.0, 0.0, 0.0])
        if self.radiation == "lungs":
            return np.array([LUNG_REFLECTION, 0.0, 0.0])
        resistance, inertance = self.radiation_resistance_inertance
        reactance = 2 * inertance / self.section_travel_s
        gamma, kappa = reactance / self.impedance_pa_s_m3[-1], reactance / resistance
        return np.array([gamma - 1 - kappa, kappa - 1 - gamma, 1 - gamma - kappa]) / (1 + gamma + kappa)


@lru_cache(maxsize=64)
def vowel_tract(
    vowel: str, density_kg_m3: float = _AIR.rho_a_kg_m3, sound_speed_m_s: float = _AIR.c_a_m_s,
    section_length_m: float = SECTION_LENGTH_M, scale: float = 1.0,
) -> Tract:  # fmt: skip
    """The tract of one of ``vfcore.spec.simulation.VOWELS`` in equal sections, with piston radiation.

    ``scale``: all lengths and diameters over the published ones.
    """
    function = resampled(scaled(area_function(vowel), scale), section_length_m)
    return Tract(function.areas_m2, function.section_length_m, density_kg_m3, sound_speed_m_s)


def stepped(flow_m3_s: np.ndarray, tract: Tract) -> LipOutput:
    """Simulate the tract from rest, wave by wave, one section of travel per step.

    ``flow_m3_s``: glottal flow, shape (n,), one value every ``tract.section_travel_s``.
    ParameterError when the flow is not a finite one-dimensional array.
    """
    flow = np.ascontiguousarray(flow_m3_s, dtype=np.float64)
    if flow.ndim != 1:
        raise ParameterError("flow_m3_s", f"shape {flow.shape} is not a waveform", "one value per time step")
    impedance = tract.impedance_pa_s_m3
    count = len(tract.areas_m2)
    output = LipOutput(np.full(flow.size, np.nan), np.full(flow.size, np.nan))
    status = advance_tract(
        flow, tract.transmission, tract.reflection, impedance[0], impedance[-1], tract.lip_reflection,
        np.zeros(count), np.zeros(count), np.zeros(1), *output,
    )  # fmt: skip
    if status != FINITE:
        raise ParameterError("flow_m3_s", "the flow has values that are not finite", "finite values, m³/s")
    return output
