"""Cycle-to-cycle perturbation: jitter, shimmer and harmonics-to-noise ratio.

They describe how a voice departs from repetition. A periodic run of a deterministic model does not, and zeros would
read as perfect health, so the catalogue gives them for irregular voices only.
"""

from math import log10

import numpy as np

from vfcore.measures.cycles import Cycles
from vfcore.measures.measure import Missing
from vfcore.measures.pitch import autocorrelation

# Beyond this the ratio measures rounding, not noise.
HIGHEST_HNR_DB = 60.0


def jitter_percent(openings: np.ndarray) -> float:
    """Mean difference between neighbouring times from one opening to the next, in % of their mean.

    ``openings``: shape (N,), one instant per cycle, any unit.
    """
    return _mean_step_percent(np.diff(openings))


def shimmer_percent(pressure_pa: np.ndarray, cycles: Cycles) -> float | Missing:
    """Mean difference between the peak-to-peak amplitudes of neighbouring cycles, in % of the mean amplitude."""
    amplitude = cycles.largest(pressure_pa) - cycles.smallest(pressure_pa)
    if amplitude.max() == 0.0:
        return Missing("There is no sound: the pressure does not change.")
    return _mean_step_percent(amplitude)


def harmonics_to_noise_db(pressure_pa: np.ndarray, cycle: float) -> float | Missing:
    """HNR = 10 log₁₀(r / (1 − r)) with r the normalised autocorrelation peak near ``cycle`` samples (Boersma 1993)."""
    r = autocorrelation(pressure_pa).near(cycle, 0.1 * cycle).height
    if r <= 0.0:
        return Missing("The sound does not resemble itself one cycle later.")
    ratio = 10.0 * log10(r / (1.0 - r)) if r < 1.0 else np.inf
    return ratio if ratio <= HIGHEST_HNR_DB else Missing("The sound repeats to within rounding: there is no noise.")


def _mean_step_percent(values: np.ndarray) -> float:
    return float(100.0 * np.abs(np.diff(values)).mean() / values.mean())
