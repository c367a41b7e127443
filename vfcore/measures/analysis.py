"""What all measures of one set of signals share, each part computed once and only when a measure needs it."""

from collections.abc import Callable
from functools import cached_property
from typing import TypeVar

import numpy as np

from vfcore.measures.cycles import Cycles, cut_cycles, refined_places
from vfcore.measures.flow import flow_slope, mean_ml_s, steepest_fall
from vfcore.measures.glottis import OpenPhases, open_phases
from vfcore.measures.level import radiated_power_w, rms_pa
from vfcore.measures.phonation import Phonation, Repetition, judge_phonation
from vfcore.measures.pitch import Autocorrelation, autocorrelation
from vfcore.measures.signals import ALTERNATIVES, SOUND, VIBRATION, Signals, Sound, with_alternatives
from vfcore.measures.vibration import AREA_BOUNDS, FLOW_BOUNDS, SOUND_BOUNDS, Vibration

NOT_JUDGED = "Not judged: neither a glottal area, nor a flow, nor a sound is given."
LEVEL_DISTANCE_M = 0.3  # at which the level of a voice is given
Found = TypeVar("Found")
_BOUNDS = {"glottal_area_m2": AREA_BOUNDS, "glottal_flow_m3_s": FLOW_BOUNDS}


class Analysis:
    """Signals, their measured part, the phonation state and the cycles found in it.

    A property raises LookupError where what it is made of is not given or was not found. The catalogue asks first.
    """

    def __init__(
        self,
        signals: Signals,
        radiate: Callable[[], Sound] | None = None,
        correlate: Callable[[], Autocorrelation] | None = None,
    ):
        self.signals = signals
        self.sample_rate_hz, self.window_start = signals.sample_rate_hz, signals.window_start
        self._radiate, self._correlate = radiate, correlate
        #: Names of the signals that are given, or computed when they are needed, and of their alternatives.
        self.given = signals.given if radiate is None else with_alternatives(signals.given.union(Sound._fields))
        #: Name of the signal on which the phonation state is judged and in which cycles are sought; None for none.
        self.judged = next((name for name in ALTERNATIVES[VIBRATION] if name in self.given), None)

    def window(self, wave: np.ndarray) -> np.ndarray:
        """The measured part of ``wave``, float64; of a float64 wave a view, to be read only."""
        return wave[self.window_start :].astype(np.float64, copy=False)

    @property
    def area(self) -> np.ndarray:
        return self.signals.wave("glottal_area_m2")

    @property
    def flow(self) -> np.ndarray:
        return self.signals.wave("glottal_flow_m3_s")

    @property
    def contact_pressure(self) -> np.ndarray:
        return self.signals.wave("contact_pressure_max_pa")

    @property
    def contact_area(self) -> np.ndarray:
        return self.signals.wave("contact_area_m2")

    @cached_property
    def _radiated(self) -> Sound | None:
        return None if self._radiate is None else self._radiate()

    @property
    def lip_pressure(self) -> np.ndarray:
        return self._radiated.lip_pressure_pa if self._radiated else self.signals.wave("lip_pressure_pa")

    @property
    def far_pressure(self) -> np.ndarray:
        return self._radiated.far_pressure_pa if self._radiated else self.signals.wave("far_pressure_pa")

    def sound(self, *preferred: str) -> np.ndarray:
        """The first of the ``preferred`` pressures, by name, that is given."""
        name = next((name for name in preferred if name in self.given), preferred[-1])
        return self.lip_pressure if name == "lip_pressure_pa" else self.far_pressure

    @cached_property
    def phonation(self) -> Phonation:
        return judge_phonation(self._vibration, self._correlate) if self.judged else Phonation("none", NOT_JUDGED)

    @cached_property
    def _vibration(self) -> Vibration:
        name = self.judged
        if name is None:
            raise LookupError(NOT_JUDGED)
        wave = self.sound(name) if name in ALTERNATIVES[SOUND] else self.signals.wave(name)
        return Vibration(self.window(wave), self.sample_rate_hz, _BOUNDS.get(name, SOUND_BOUNDS))

    @property
    def repetition(self) -> Repetition:
        return _found(self.phonation.repetition, "repetition")

    @cached_property
    def followed_cycles(self) -> Cycles | None:
        """The cycles, or None where none can be followed."""
        if self.phonation.repetition is None:
            return None
        return cut_cycles(self._vibration.source, self.window_start, self.phonation)

    @property
    def cycles(self) -> Cycles:
        return _found(self.followed_cycles, "cycles")

    @cached_property
    def fo_hz(self) -> float:
        """Reciprocal of the pattern; of an irregular voice, of the mean cycle, Hz."""
        if self.phonation.state == "irregular":
            return float(self.sample_rate_hz / float(np.diff(self.cycle_instants).mean()))
        return float(self.sample_rate_hz / self.repetition.pattern)

    @cached_property
    def cycle_instants(self) -> np.ndarray:
        """One instant per cycle, samples, sub-sample; shape (N,) or, without an area, (N − 1,).

        When the glottis opens; where its area is not given, when the flow falls steepest between two of its peaks, in a
        sound the lowest pressure.
        """
        if self.judged == "glottal_area_m2":
            return self.open_phases.opens
        flow = self._after_silence(self._vibration.source, self.window_start)
        falls = self.cycles.between(self.cycles.where_largest(flow))
        if self.judged == "glottal_flow_m3_s":
            slope = self._after_silence(flow_slope(flow, self.sample_rate_hz, self.cycles), self.cycles.bounds[0])
        else:
            slope = self._after_silence(self._vibration.wave, self.window_start)
        return refined_places(-slope, falls.where_largest(-slope))

    @staticmethod
    def _after_silence(part: np.ndarray, start: int) -> np.ndarray:
        """A part of a wave at its place in the whole one, 0 before."""
        return np.concatenate((np.zeros(start), part))

    def _contact_cycles(self, contact: np.ndarray) -> Cycles:
        """Cycles that cut no contact in two: from area peak to area peak, or in the middle of the time without contact
        if the area is not given.
        """
        if self.judged == "glottal_area_m2":
            return self._cycles_between_area_peaks
        wave = self.window(contact)
        correlation = None if self.phonation.state == "periodic" else autocorrelation(wave)
        return cut_cycles(wave, self.window_start, self.phonation, correlation) or self.cycles

    @cached_property
    def _cycles_between_area_peaks(self) -> Cycles:
        return self.cycles.between(self.area_peaks)

    @cached_property
    def contact_pressure_cycles(self) -> Cycles:
        return self._contact_cycles(self.contact_pressure)

    @cached_property
    def contact_area_cycles(self) -> Cycles:
        return self._contact_cycles(self.contact_area)

    @cached_property
    def open_phases(self) -> OpenPhases:
        return open_phases(self.area, self.cycles, self.area_peaks)

    @cached_property
    def area_peaks(self) -> np.ndarray:
        """Sample of the largest area of each cycle; shape (N,)."""
        return self.cycles.where_largest(self.area)

    @cached_property
    def contact_peaks(self) -> np.ndarray:
        """Sample of the largest contact pressure of each of the contact cycles; shape (N − 1,) or less."""
        return self.contact_pressure_cycles.where_largest(self.contact_pressure)

    @cached_property
    def largest_contact_m2(self) -> np.ndarray:
        """Largest contact area of each of the contact cycles, m²."""
        return self.contact_area_cycles.largest(self.contact_area)

    @cached_property
    def smallest_flow_m3_s(self) -> np.ndarray:
        """Smallest flow of each cycle, m³/s."""
        return self.cycles.smallest(self.flow)

    @cached_property
    def flow_swing_m3_s(self) -> np.ndarray:
        """Largest minus smallest flow of each cycle, m³/s."""
        return self.cycles.largest(self.flow) - self.smallest_flow_m3_s

    @cached_property
    def flow_fall_m3_s2(self) -> np.ndarray:
        """Steepest fall of the flow in each cycle, m³/s²."""
        return steepest_fall(flow_slope(self.flow, self.sample_rate_hz, self.cycles), self.cycles)

    @cached_property
    def mean_flow_ml_s(self) -> float:
        """Mean flow over whole cycles, or over the measured part where there are none, mL/s."""
        cycles = self.followed_cycles
        return mean_ml_s(cycles.span(self.flow) if cycles else self.window(self.flow))

    @cached_property
    def lip_rms_pa(self) -> float:
        """Root-mean-square of the pressure at the lips in the measured part, about its mean, Pa."""
        return rms_pa(self.window(self.lip_pressure))

    @cached_property
    def far_rms_pa(self) -> float:
        """Root-mean-square of the far pressure in the measured part, about its mean, Pa."""
        return rms_pa(self.window(self.far_pressure))

    @property
    def rms_at_30cm_pa(self) -> float:
        """``far_rms_pa`` as it would be at 0.3 m: the pressure of a simple source falls with distance, Pa."""
        return self.far_rms_pa * (self.signals.number("far_distance_m") / LEVEL_DISTANCE_M)

    @property
    def radiated_power_w(self) -> float:
        """Power of a simple source that makes the far pressure in the measured part, W."""
        s = self.signals
        distance_m = s.number("far_distance_m")
        return radiated_power_w(self.far_rms_pa, distance_m, s.air_density_kg_m3, s.sound_speed_m_s)


def _found(value: Found | None, what: str) -> Found:
    if value is None:
        raise LookupError(f"no {what} in these signals")
    return value
