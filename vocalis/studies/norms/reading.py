"""Numbers of a run, measured in the way of the norms.

Flow norms come from inverse-filtered mask recordings, whose bandwidth is about 1 kHz: the flow is low-passed at MASK_HZ
first (Gaussian, −3 dB), and open and rising times are read where the flow exceeds its minimum by ABOVE_BASELINE of its
peak-to-peak value, because most speakers have a posterior leak.
"""

from itertools import pairwise
from math import log, nan, pi, sqrt
from typing import NamedTuple

import numpy as np
from scipy.ndimage import gaussian_filter1d

from vfcore.runs.result import SimulationResult

MASK_HZ = 1000.0
ABOVE_BASELINE = 0.2


class FlowMeasures(NamedTuple):
    """Measures of the low-passed flow, means over cycles: mL/s, L/s², and ratios."""

    ac_ml_s: float = nan
    min_ml_s: float = nan
    mfdr_l_s2: float = nan
    open_quotient: float = nan
    speed_quotient: float = nan


class NormReading(NamedTuple):
    """Numbers of one run: phonation state, measures of the catalogue by key (NaN if missing), flow as seen by a
    mask.
    """

    state: str
    measures: dict[str, float]
    flow: FlowMeasures


NO_VOICE = "none"


def reading(result: SimulationResult) -> NormReading:
    """The numbers of a run."""
    measures = {key: nan if m.value is None else float(m.value) for key, m in result.report.measures.items()}
    flow = FlowMeasures()
    if np.isfinite(measures["fo_hz"]):
        rate = result.provenance.sample_rate_hz
        flow = flow_measures(result.arrays["glottal_flow_m3_s"], rate, measures["fo_hz"])
    return NormReading(result.report.state, measures, flow)


def flow_measures(flow_m3_s: np.ndarray, sample_rate_hz: float, fo_hz: float) -> FlowMeasures:
    """Measures of the last half of a flow, shape (n,), cycle by cycle of length 1/f_o."""
    sigma = sqrt(log(2.0)) / (2 * pi * MASK_HZ) * sample_rate_hz
    reach = int(4 * sigma) + 1  # no flow beyond the end
    smooth = gaussian_filter1d(flow_m3_s, sigma)[:-reach] * 1e6
    slope = np.diff(smooth, prepend=smooth[0]) * sample_rate_hz * 1e-3
    period = sample_rate_hz / fo_hz
    count = int(len(smooth) / 2 / period) - 1
    if count < 1:
        return FlowMeasures()
    bounds = len(smooth) - np.round(np.arange(count, -1, -1) * period).astype(int)
    cycles = [_cycle(smooth[a:b], slope[a:b]) for a, b in pairwise(bounds)]
    return FlowMeasures(*(float(mean) for mean in np.mean(cycles, axis=0)))


def _cycle(flow_ml_s: np.ndarray, slope_l_s2: np.ndarray) -> tuple[float, float, float, float, float]:
    """The measures of one cycle, which starts at the smallest flow."""
    wave = np.roll(flow_ml_s, -int(flow_ml_s.argmin()))
    low, swing = float(wave.min()), float(np.ptp(wave))
    above = np.flatnonzero(wave > low + ABOVE_BASELINE * swing)
    peak = int(wave.argmax())
    rising, falling = peak - above[0], above[-1] - peak
    return swing, low, -float(slope_l_s2.min()), len(above) / len(wave), rising / falling if falling > 0 else nan
