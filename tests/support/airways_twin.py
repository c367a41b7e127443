"""Slow, obvious twin of two-way coupling: waves in two tubes as lists, the flow by a bracketing root finder.

Written from the derivation in docs/model/equations.md, independent of the compiled kernel that it checks. Every wave
crosses one section per step; the glottis is any function from pressure drop to flow.
"""

from collections.abc import Callable

import numpy as np
from scipy.optimize import brentq

from vfcore.airways.coupled import STEADY_BELOW_HZ, Airways
from vfcore.airways.tract import Tract


class TubeTwin:
    """One airway seen from the glottis: pressures, Pa, of outgoing and returning waves, section by section."""

    def __init__(self, tract: Tract):
        self.impedance = tract.impedance_pa_s_m3
        self.kept = tract.transmission
        self.end = tract.lip_reflection
        self.away = [0.0] * len(self.kept)  # waves at the glottal end of their section, about to cross it
        self.back = [0.0] * len(self.kept)  # waves at the far end of their section, about to cross it
        self.last_in = self.last_out = 0.0

    def arriving(self) -> float:
        """The wave that reaches the glottis in this step."""
        return self.kept[0] * self.back[0]

    def step(self, leaving_glottis: float) -> None:
        count = len(self.kept)
        arrived_away = [self.kept[i] * self.away[i] for i in range(count)]
        arrived_back = [self.kept[i] * self.back[i] for i in range(count)]
        away, back = [0.0] * count, [0.0] * count
        away[0] = leaving_glottis
        for i in range(count - 1):  # pressure and flow are continuous at the junction of sections i and i + 1
            Z, Z_next = self.impedance[i], self.impedance[i + 1]
            pressure = 2 * (arrived_away[i] / Z + arrived_back[i + 1] / Z_next) / (1 / Z + 1 / Z_next)
            back[i], away[i + 1] = pressure - arrived_away[i], pressure - arrived_back[i + 1]
        b0, b1, a1 = self.end
        reflected = b0 * arrived_away[-1] + b1 * self.last_in - a1 * self.last_out
        self.last_in, self.last_out = arrived_away[-1], reflected
        back[-1] = reflected
        self.away, self.back = away, back


class AirwaysTwin:
    """Both airways and the glottis; ``step(P_s, flow_of)`` advances them by one section of travel."""

    def __init__(self, airways: Airways):
        self.below, self.above = TubeTwin(airways.subglottal), TubeTwin(airways.supraglottal)
        self.excess = airways.excess_resistance
        self.share = 2 * np.pi * STEADY_BELOW_HZ * airways.subglottal.section_travel_s
        self.slow = 0.0
        self.flow, self.inlet, self.outlet = 0.0, np.nan, np.nan

    def step(self, P_s: float, flow_of: Callable[[float], float]) -> None:
        """``flow_of(drop)``: flow through the glottis, m³/s, increasing with the drop, Pa."""
        Z_s, Z_v = self.below.impedance[0], self.above.impedance[0]
        B_s, B_v = self.below.arriving(), self.above.arriving()
        closed_inlet = P_s + 2 * B_s + self.excess[0] * self.slow
        closed_outlet = 2 * B_v - self.excess[1] * self.slow
        D = closed_inlet - closed_outlet
        root = brentq(lambda drop: drop + (Z_s + Z_v) * flow_of(drop) - D, min(D, 0.0) - 1, max(D, 0.0) + 1, xtol=1e-9)
        self.flow = (D - root) / (Z_s + Z_v)
        self.inlet, self.outlet = closed_inlet - Z_s * self.flow, closed_outlet + Z_v * self.flow
        self.slow += self.share * (self.flow - self.slow)
        self.below.step(B_s - Z_s * self.flow)
        self.above.step(B_v + Z_v * self.flow)


def law_of(A: np.ndarray, B: np.ndarray, width: np.ndarray) -> Callable[[float], float]:
    """Total flow of slices with A q |q| + B q = drop; a slice with ``width`` 0 or infinite A is closed."""

    def flow(drop: float) -> float:
        size = abs(drop)
        return float(np.sign(drop) * np.sum(width * 2 * size / (B + np.sqrt(B**2 + 4 * A * size) + 1e-300)))

    return flow
