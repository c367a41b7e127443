"""Contours of f_o and level: one value per block, from a short window around it.

f_o: the first autocorrelation peak of the glottal area that is nearly as high as the highest (within NEARLY), in a
window of 60 ms; NaN where the area changes too little to be audible or no cycle can be tracked (the bounds of
``vfcore.measures.vibration`` and ``phonation``). Level: rms of the pressure about its mean over the same window, dB re
20 µPa; NaN without sound.
"""

import numpy as np

from vfcore.kernels.repetition import first_period, likeness
from vfcore.measures.level import rms_pa, sound_pressure_level_db
from vfcore.measures.measure import Missing
from vfcore.measures.phonation import MIN_TRACKABLE
from vfcore.measures.pitch import HIGHEST_RATE_HZ, PEAK_RISE
from vfcore.measures.vibration import MIN_AREA_SWING_M2, MIN_RELATIVE_SWING

WINDOW_S = 0.060  # four cycles of the lowest voices of men, about 70 Hz
NEARLY = 0.95


def pitch_hz(area_m2: np.ndarray, sample_rate_hz: float) -> float:
    """f_o in one window of the minimum glottal area, Hz; NaN where there is none."""
    swing = float(np.ptp(area_m2)) if len(area_m2) else 0.0
    if swing < MIN_AREA_SWING_M2 or swing < MIN_RELATIVE_SWING * float(area_m2.mean()):
        return float("nan")
    values = np.empty(len(area_m2) // 2 + 2)
    likeness(area_m2, np.empty(len(area_m2)), values)
    shortest = max(int(sample_rate_hz / HIGHEST_RATE_HZ), 2)
    lags, heights = np.empty((2, len(values) // 2 + 1))
    return sample_rate_hz / first_period(values, shortest, PEAK_RISE, MIN_TRACKABLE, NEARLY, lags, heights)


def level_db(pressure_pa: np.ndarray) -> float:
    """Level in one window, dB re 20 µPa; NaN without sound."""
    level = sound_pressure_level_db(rms_pa(pressure_pa)) if len(pressure_pa) else Missing("no samples")
    return float("nan") if isinstance(level, Missing) else level


def contour(function, wave: np.ndarray, sample_rate_hz: float, times_s: np.ndarray) -> np.ndarray:
    """``function`` over the window around each time; windows are cut short at both ends."""
    half = round(0.5 * WINDOW_S * sample_rate_hz)
    centres = np.rint(times_s * sample_rate_hz).astype(int)
    return np.array([function(wave[max(0, at - half) : at + half]) for at in centres])
