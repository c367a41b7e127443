"""The airways below and above the glottis, cut so that a whole number of sections passes in a step of the fold.

What a steady flow meets is set apart from the losses of sound (vfcore.kernels.airways): nothing above the glottis,
where the viscous resistance of an open vowel is a few Pa per L/s, and LUNG_RESISTANCE below it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from vfcore.airways.resonances import input_impedance
from vfcore.airways.subglottal import subglottal_tract
from vfcore.airways.tract import Tract, vowel_tract
from vfcore.errors import ParameterError
from vfcore.kernels import airways as kernel
from vfcore.kernels import airways_many as many
from vfcore.kernels.simd import aligned_zeros
from vfcore.spec.area_functions import SECTION_LENGTH_M, SECTION_LIMITS_M
from vfcore.spec.simulation import Simulation

#: Flow resistance of trachea and bronchi of adults, about half of an airway resistance of 2 cmH₂O per L/s; approximate.
LUNG_RESISTANCE_PA_S_M3 = 1e5
#: Below this frequency a flow counts as steady: far below any f_o.
STEADY_BELOW_HZ = 10.0


@dataclass(frozen=True)
class Airways:
    """The tracts below and above the glottis; a step of the fold is ``substeps`` sections of travel in both."""

    subglottal: Tract
    supraglottal: Tract
    substeps: int

    @property
    def excess_resistance(self) -> tuple[float, float]:
        """What the losses of sound would be to a steady flow beyond its true resistance, below and above; Pa·s/m³."""
        below, above = (float(input_impedance(tract, 0.0).real) for tract in (self.subglottal, self.supraglottal))
        return below - LUNG_RESISTANCE_PA_S_M3, above

    def rows(self, air: np.ndarray) -> list[np.ndarray]:
        """Views of a buffer, (len(ROWS), sections) of the airway below and of the one above."""
        views, start = [], kernel.HEADER
        for tract in (self.subglottal, self.supraglottal):
            count = len(tract.areas_m2)
            length = kernel.row_length(count)
            block = air[start : start + len(kernel.ROWS) * length].reshape(len(kernel.ROWS), length)
            views.append(block[:, :count])
            start += block.size
        return views

    def new_buffer(self, pressure_pa: float) -> np.ndarray:
        """The buffer of vfcore.kernels.airways: at rest under a transglottal pressure, glottis closed."""
        below, above = self.subglottal, self.supraglottal
        n_s, n_v = len(below.areas_m2), len(above.areas_m2)
        air = np.zeros(kernel.HEADER + len(kernel.ROWS) * (kernel.row_length(n_s) + kernel.row_length(n_v)))
        air[kernel.SUBSTEPS], air[kernel.SECTIONS_S], air[kernel.SECTIONS_V] = self.substeps, n_s, n_v
        air[kernel.IMPEDANCE_S], air[kernel.IMPEDANCE_V] = below.impedance_pa_s_m3[0], above.impedance_pa_s_m3[0]
        air[kernel.END_S : kernel.END_S + 3] = below.lip_reflection
        air[kernel.END_V : kernel.END_V + 3] = above.lip_reflection
        air[kernel.EXCESS_S], air[kernel.EXCESS_V] = self.excess_resistance
        air[kernel.SLOW_SHARE] = 2 * np.pi * STEADY_BELOW_HZ * below.section_travel_s
        air[kernel.DROP], air[kernel.VISCOUS_SHARE] = pressure_pa, 1.0
        for tract, rows in zip((below, above), self.rows(air), strict=True):
            rows[kernel.ROWS.index("transmission")] = tract.transmission
            rows[kernel.ROWS.index("reflection"), :-1] = tract.reflection
        return air

    @property
    def shape(self) -> tuple[int, int, int]:
        """Steps of the airways per step of the fold, and sections below and above: common to the folds of a batch."""
        return self.substeps, len(self.subglottal.areas_m2), len(self.supraglottal.areas_m2)

    @staticmethod
    def new_buffers(folds: Sequence[tuple["Airways", float]], dtype: str = "float64") -> np.ndarray:
        """The buffer of vfcore.kernels.airways_many for the airways of several folds, each with its pressure in Pa.

        At rest, like ``new_buffer``, and aligned to a cache line; a copy should be too, or it is a third slower.
        ParameterError for airways of different ``shape``.
        """
        shapes = sorted({ways.shape for ways, _ in folds})
        if len(shapes) > 1:
            raise ParameterError("airways.shape", " and ".join(map(str, shapes)), "the same for all folds of a batch")
        _, n_s, n_v = shapes[0]
        below = [Scattering.of(ways.subglottal) for ways, _ in folds]
        above = [Scattering.of(ways.supraglottal) for ways, _ in folds]
        junctions = np.flatnonzero(np.any([one.ahead != 0 for one in below], axis=0))
        begin_junctions = many.HEADER + 2 * n_s
        begin_v = begin_junctions + many.JUNCTION * len(junctions)
        air = np.zeros((begin_v + many.SECTION * n_v, len(folds)))
        for k, (ways, pressure_pa) in enumerate(folds):
            header = air[: many.HEADER, k]
            header[: many.ARRIVAL_S] = ways.new_buffer(pressure_pa)[: many.ARRIVAL_S]
            header[many.ARRIVAL_S], header[many.ARRIVAL_V] = below[k].arrival, above[k].arrival
            header[many.JUNCTIONS_S] = len(junctions)
            for end, tract in ((many.END_S, below[k]), (many.END_V, above[k])):
                header[end : end + 2] *= tract.end
            at_junctions = np.column_stack((junctions, below[k].ahead[junctions], below[k].behind[junctions]))
            air[begin_junctions:begin_v, k] = at_junctions.ravel()
            sections = np.zeros((n_v, many.SECTION))
            sections[:-1, 2], sections[:-1, 3] = above[k].ahead, above[k].behind
            air[begin_v:, k] = sections.ravel()
        buffer = aligned_zeros(air.size, dtype)
        buffer[:] = air.ravel()
        return buffer


class Scattering(NamedTuple):
    """How the scaled waves of vfcore.kernels.airways_many scatter in a tract; all dimensionless."""

    ahead: np.ndarray  #: g of each junction, (sections − 1,)
    behind: np.ndarray  #: h of each junction, (sections − 1,)
    arrival: float  #: β of the section at the glottis
    end: float  #: α of the last section

    @classmethod
    def of(cls, tract: Tract) -> "Scattering":
        """The coefficients of a tract."""
        t, r = tract.transmission, tract.reflection
        alpha = t[0] * np.cumprod(np.append(1.0, t[1:] * (1 + r)))
        beta = t[-1] * np.cumprod(np.append(1.0, (t[:-1] * (1 - r))[::-1]))[::-1]
        ahead, behind = -r * beta[1:] / ((1 + r) * alpha[:-1]), r * alpha[:-1] / ((1 - r) * beta[1:])
        return cls(ahead, behind, float(beta[0]), float(alpha[-1]))


@lru_cache(maxsize=64)
def airways(
    vowel: str, density_kg_m3: float, sound_speed_m_s: float, time_step_s: float, scale: float = 1.0
) -> Airways:  # fmt: skip
    """The airways of a vowel for a step of the fold: sections of about SECTION_LENGTH_M, a whole number per step.

    ParameterError for a step in which sound does not pass the shortest section.
    """
    travel = sound_speed_m_s * time_step_s
    substeps = max(1, round(travel / SECTION_LENGTH_M))
    section = travel / substeps
    if section < SECTION_LIMITS_M[0]:
        raise ParameterError(
            "run.time_step_s", f"{time_step_s:.3g} s is too short for two-way coupling",
            f"{SECTION_LIMITS_M[0] / sound_speed_m_s:.3g} s or longer; or model.coupling one_way",
        )  # fmt: skip
    air = (density_kg_m3, sound_speed_m_s)
    return Airways(subglottal_tract(section, *air, scale), vowel_tract(vowel, *air, section, scale), substeps)


def tract_of(request: Simulation) -> Tract:
    """The vocal tract of a request in sections of SECTION_LENGTH_M, for the sound of one-way coupling."""
    air = request.constants
    return vowel_tract(
        request.vowel, air.rho_a_kg_m3, air.c_a_m_s, scale=request.larynx.airways.airway_scale
    )  # fmt: skip


def airways_of(request: Simulation, step_s: float) -> Airways | None:
    """What acts back on the folds: both airways with two-way coupling, None with one-way."""
    if request.model.coupling == "one_way":
        return None
    air = request.constants
    return airways(request.vowel, air.rho_a_kg_m3, air.c_a_m_s, step_s, request.larynx.airways.airway_scale)
