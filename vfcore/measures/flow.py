"""Measures of the glottal flow: volumes per second, the steepest fall, and the amplitude quotient.

The derivative is the flow convolved with the derivative of a Gaussian: low-pass and derivative in one step, without
delay and without overshoot, so that no ringing adds to the steepest fall. Its gain is exp(−(2πfσ)²/2), −3 dB at
σ = √(ln 2) / (2π f_c).
"""

from math import log, pi, sqrt

import numpy as np

from vfcore.kernels.slope import gaussian_slope
from vfcore.measures.cycles import Cycles, plain
from vfcore.measures.measure import Missing

# Below it lies nearly all energy of a glottal pulse; above it the area, cut off at 0, has corners that only the
# sample rate would round. Inverse filtering in the clinic is limited to 1–4 kHz.
SLOPE_CUTOFF_HZ = 3000.0
# Where the Gaussian is cut off, in σ: 1e-8 of its height.
REACH = 6.0


def mean_ml_s(flow_m3_s: np.ndarray) -> float:
    """Mean of a flow, shape (n,), m³/s, in mL/s."""
    return float(flow_m3_s.mean() * 1e6)


def ac_ml_s(swing_m3_s: np.ndarray) -> float:
    """Mean over cycles of largest minus smallest flow, mL/s."""
    return float(swing_m3_s.mean() * 1e6)


def min_ml_s(smallest_m3_s: np.ndarray) -> float:
    """Mean over cycles of the smallest flow, mL/s."""
    return float(smallest_m3_s.mean() * 1e6)


def flow_slope(flow_m3_s: np.ndarray, sample_rate_hz: float, cycles: Cycles) -> np.ndarray:
    """Low-passed dQ/dt over the span of ``cycles``, m³/s²."""
    sigma = sqrt(log(2.0)) / (2.0 * pi * SLOPE_CUTOFF_HZ) * sample_rate_hz
    slope = np.empty(cycles.bounds[-1] - cycles.bounds[0])
    gaussian_slope(plain(flow_m3_s), cycles.bounds[0], sigma, round(REACH * sigma), slope)
    return slope * sample_rate_hz


def steepest_fall(slope_m3_s2: np.ndarray, cycles: Cycles) -> np.ndarray:
    """−min dQ/dt of each cycle, m³/s²; shape (N,)."""
    return -np.minimum.reduceat(slope_m3_s2, cycles.offsets)


def mfdr_l_s2(fall_m3_s2: np.ndarray) -> float:
    """Maximum flow declination rate: mean over cycles of the steepest fall, L/s²."""
    return float(fall_m3_s2.mean() * 1e3)


def naq(swing_m3_s: np.ndarray, fall_m3_s2: np.ndarray, period_s: np.ndarray) -> float | Missing:
    """Normalised amplitude quotient (AC / |d_min|) / T, mean over the cycles whose flow falls (Alku et al. 2002)."""
    falls = fall_m3_s2 > 0.0
    if not falls.any():
        return Missing("The flow does not fall in any cycle.")
    return float((swing_m3_s[falls] / fall_m3_s2[falls] / period_s[falls]).mean())
