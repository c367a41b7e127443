"""The airways below and above the glottis, cut so that a whole number of sections passes in a step of the fold.

What a steady flow meets is set apart from the losses of sound (vfcore.kernels.airways): nothing above the glottis,
where the viscous resistance of an open vowel is a few Pa per L/s, and LUNG_RESISTANCE below it.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from vfcore.airways.resonances import input_impedance
from vfcore.airways.subglottal import subglottal_tract
from vfcore.airways.tract import Tract, vowel_tract
from vfcore.errors import ParameterError
from vfcore.kernels import airways as kernel
from vfcore.kernels import airways_many
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
    def new_buffers(folds: list[tuple["Airways", float]], dtype: str = "float64") -> np.ndarray:
        """The buffer of vfcore.kernels.airways_many for airways of one ``shape``, each with its pressure in Pa.

        At rest, like ``new_buffer``. ParameterError for airways of different shapes.
        """
        shapes = sorted({ways.shape for ways, _ in folds})
        if len(shapes) > 1:
            raise ParameterError("airways.shape", " and ".join(map(str, shapes)), "one shape in a batch")
        _, n_s, n_v = shapes[0]
        per_section = airways_many.PER_SECTION
        air = np.zeros((airways_many.HEADER + per_section * (n_s + n_v), len(folds)))
        for (ways, pressure_pa), column in zip(folds, air.T, strict=True):
            column[: kernel.HEADER] = ways.new_buffer(pressure_pa)[: kernel.HEADER]
            sections = column[airways_many.HEADER :].reshape(-1, per_section)
            for tract, rows, end, arrival in (
                (ways.subglottal, sections[:n_s], kernel.END_S, airways_many.ARRIVAL_S),
                (ways.supraglottal, sections[n_s:], kernel.END_V, airways_many.ARRIVAL_V),
            ):
                alpha, beta = scales(tract)
                r = tract.reflection
                rows[:-1, airways_many.SECTION.index("ahead")] = -r * beta[1:] / ((1 + r) * alpha[:-1])
                rows[:-1, airways_many.SECTION.index("behind")] = r * alpha[:-1] / ((1 - r) * beta[1:])
                column[end : end + 2] *= alpha[-1]
                column[arrival] = beta[0]
        return np.ascontiguousarray(air, dtype).reshape(-1)


def scales(tract: Tract) -> tuple[np.ndarray, np.ndarray]:
    """α and β of vfcore.kernels.airways_many: waves over scaled waves, away from the glottis and back; (sections,)."""
    kept, r = tract.transmission, tract.reflection
    alpha = kept * np.cumprod(np.append(1.0, kept[:-1] * (1 + r)))
    beta = kept * np.cumprod(np.append(1.0, (kept[1:] * (1 - r))[::-1]))[::-1]
    return alpha, beta


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
