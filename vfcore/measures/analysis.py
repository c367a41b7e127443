"""What all measures of one run share, each part worked out once and only when a measure asks for it."""

from collections.abc import Callable
from functools import cached_property

import numpy as np

from vfcore.measures.cycles import Cycles, cut_cycles
from vfcore.measures.flow import flow_slope, mean_ml_s, steepest_fall
from vfcore.measures.glottis import OpenPhases, open_phases
from vfcore.measures.level import radiated_power_w, rms_pa
from vfcore.measures.phonation import Phonation, judge_phonation
from vfcore.measures.pitch import Autocorrelation
from vfcore.measures.signals import Signals, Sound


class Analysis:
    """Signals of one run, the window, the phonation state and the cycles found in it."""

    def __init__(
        self,
        signals: Signals,
        radiate: Callable[[], Sound] | None = None,
        correlate: Callable[[], Autocorrelation] | None = None,
    ):
        self.signals = signals
        self._radiate, self._correlate = radiate, correlate

    @cached_property
    def sound(self) -> Sound:
        """Pressure at the lips and far away, given with the signals or worked out now."""
        if self._radiate is None:
            return Sound(self.signals.lip_pressure_pa, self.signals.far_pressure_pa)
        return self._radiate()

    def window(self, wave: np.ndarray) -> np.ndarray:
        """The measured half of ``wave``, float64; of a float64 wave a view, to be read only."""
        return wave[self.signals.window_start :].astype(np.float64, copy=False)

    @cached_property
    def phonation(self) -> Phonation:
        area = self.window(self.signals.glottal_area_m2)
        return judge_phonation(area, self.signals.sample_rate_hz, self._correlate)

    @cached_property
    def cycles(self) -> Cycles | None:
        return cut_cycles(self.signals.glottal_area_m2, self.signals.window_start, self.phonation)

    @cached_property
    def contact_cycles(self) -> Cycles:
        """Cycles from area peak to area peak, so that no contact is cut in two."""
        return self.cycles.between(self.area_peaks)

    @cached_property
    def open_phases(self) -> OpenPhases:
        return open_phases(self.signals.glottal_area_m2, self.cycles, self.area_peaks)

    @cached_property
    def area_peaks(self) -> np.ndarray:
        """Sample of the largest area of each cycle; shape (N,)."""
        return self.cycles.where_largest(self.signals.glottal_area_m2)

    @cached_property
    def contact_peaks(self) -> np.ndarray:
        """Sample of the largest contact pressure of each of the contact cycles; shape (N − 1,) or less."""
        return self.contact_cycles.where_largest(self.signals.contact_pressure_max_pa)

    @cached_property
    def largest_contact_m2(self) -> np.ndarray:
        """Largest contact area of each of the contact cycles, m²."""
        return self.contact_cycles.largest(self.signals.contact_area_m2)

    @cached_property
    def smallest_flow_m3_s(self) -> np.ndarray:
        """Smallest flow of each cycle, m³/s."""
        return self.cycles.smallest(self.signals.glottal_flow_m3_s)

    @cached_property
    def flow_swing_m3_s(self) -> np.ndarray:
        """Largest minus smallest flow of each cycle, m³/s."""
        return self.cycles.largest(self.signals.glottal_flow_m3_s) - self.smallest_flow_m3_s

    @cached_property
    def flow_fall_m3_s2(self) -> np.ndarray:
        """Steepest fall of the flow in each cycle, m³/s²."""
        slope = flow_slope(self.signals.glottal_flow_m3_s, self.signals.sample_rate_hz, self.cycles)
        return steepest_fall(slope, self.cycles)

    @cached_property
    def mean_flow_ml_s(self) -> float:
        """Mean flow over whole cycles, or over the window where there are none, mL/s."""
        wave = self.signals.glottal_flow_m3_s
        return mean_ml_s(self.cycles.span(wave) if self.cycles else self.window(wave))

    @cached_property
    def lip_rms_pa(self) -> float:
        """Root-mean-square of the pressure at the lips in the window, about its mean, Pa."""
        return rms_pa(self.window(self.sound.lip_pressure_pa))

    @cached_property
    def far_rms_pa(self) -> float:
        """Root-mean-square of the far pressure in the window, about its mean, Pa."""
        return rms_pa(self.window(self.sound.far_pressure_pa))

    @property
    def radiated_power_w(self) -> float:
        """Power of a simple source that makes the far pressure in the window, W."""
        s = self.signals
        return radiated_power_w(self.far_rms_pa, s.far_distance_m, s.air_density_kg_m3, s.sound_speed_m_s)
