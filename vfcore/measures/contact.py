"""Contact between the folds: pressure, place, impulse, area and duration.

The cycles run from one peak of the glottal area to the next, or between the middles of the times without contact where
there is no area, so that each holds one whole contact.

A cycle without contact has contact pressure, impulse, area and quotient 0; that is a finding, not a missing value.
Only the place of the contact is then missing.
"""

import numpy as np

from vfcore.kernels.cycles import time_above
from vfcore.measures.cycles import Cycles, plain
from vfcore.measures.measure import Missing

# Criterion level of electroglottography, as a fraction of the cycle's largest contact area (Orlikoff 1991).
CONTACT_FRACTION = 0.25


def pressure_max_pa(pressure_pa: np.ndarray, largest_at: np.ndarray) -> float:
    """Mean over cycles of the largest contact pressure over x, y and t, Pa, found at the samples ``largest_at``."""
    return float(pressure_pa[largest_at].mean(dtype=np.float64))


def location(location_x_over_l: np.ndarray, largest_at: np.ndarray) -> float | Missing:
    """Mean over cycles, those with contact, of x/L of the largest contact pressure, at the samples ``largest_at``."""
    places = location_x_over_l[largest_at].astype(np.float64)
    places = places[np.isfinite(places)]
    return float(places.mean()) if len(places) else Missing("The folds never touch, so the contact has no place.")


def impulse_pa_s(pressure_pa: np.ndarray, cycles: Cycles, sample_rate_hz: float) -> float:
    """Mean over cycles of the time integral of the positive part of the largest contact pressure, Pa·s."""
    return float(cycles.total(np.maximum(cycles.span(pressure_pa), 0.0)).mean() / sample_rate_hz)


def area_mm2(largest_m2: np.ndarray) -> float:
    """Mean over cycles of the largest contact area, mm²."""
    return float(largest_m2.mean() * 1e6)


def area_fraction(largest_m2: np.ndarray, medial_area_m2: float) -> float:
    """Mean over cycles of the largest share of the medial surface in contact."""
    return float(largest_m2.mean() / medial_area_m2)


def contact_quotient(contact_area_m2: np.ndarray, largest_m2: np.ndarray, cycles: Cycles) -> float:
    """Mean fraction of the cycle with contact area above a quarter of the cycle's largest.

    Crossings are not interpolated: the contact area of a grid moves in steps of one node.
    """
    shares = np.empty(cycles.count)
    time_above(plain(contact_area_m2), cycles.bounds, CONTACT_FRACTION * largest_m2, shares)
    return float(shares.mean())
