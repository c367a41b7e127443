"""Waves whose measures are known analytically, for the tests of the measures.

All are sampled functions of continuous time; nothing here depends on the code under test.
"""

from dataclasses import replace

import numpy as np
from scipy.optimize import brentq

from vfcore.measures.signals import Signals

RATE_HZ = 35_000.0
MM2 = 1e-6


def times(duration_s: float = 1.0, rate_hz: float = RATE_HZ) -> np.ndarray:
    """Sample times, shape (n,), s."""
    return np.arange(round(duration_s * rate_hz)) / rate_hz


def triangle(phase, closed_quotient: float, speed_quotient: float):
    """Triangular pulse of height 1 over ``phase`` (cycles): rises for OQ·SQ/(1+SQ), falls to OQ, closed after."""
    phase = np.mod(phase, 1.0)
    open_time = 1.0 - closed_quotient
    rise = open_time * speed_quotient / (1.0 + speed_quotient)
    return np.clip(np.minimum(phase / rise, (open_time - phase) / (open_time - rise)), 0.0, None)


def raised_pulse(phase, closed_quotient: float, speed_quotient: float):
    """As ``triangle``, but smooth: sin² over the rise and over the fall."""
    return np.sin(np.pi / 2 * triangle(phase, closed_quotient, speed_quotient)) ** 2


def steady_phase(t, fo_hz: float, offset: float = 0.37):
    """Phase in cycles at a constant rate."""
    return fo_hz * t + offset


def alternating(phase, weaker: float, count: int = 2):
    """Height 1 for the first of every ``count`` cycles, ``weaker`` for the others."""
    return np.where(np.floor(phase) % count == 0, 1.0, weaker)


class LiljencrantsFant:
    """The LF flow pulse (Fant, Liljencrants & Lin 1985) of unit period and steepest fall E_e.

    dQ/dt = E_0 e^{αt} sin(ω_g t) up to t_e, then −(E_e/(ε t_a)) (e^{−ε(t−t_e)} − e^{−ε(1−t_e)}) up to 1.
    Times are fractions of the period; ε and α follow from continuity and from zero net flow.
    """

    def __init__(self, t_p: float = 0.45, t_e: float = 0.6, t_a: float = 0.02):
        self.t_e, self.t_a, self.omega = t_e, t_a, np.pi / t_p
        self.epsilon = brentq(lambda e: e * t_a - 1 + np.exp(-e * (1 - t_e)), 1e-3 / t_a, 2 / t_a)
        self.alpha = brentq(lambda alpha: self._open_flow(t_e, alpha) + self._return_area(), -50.0, 50.0)
        self.peak_flow = float(self._open_flow(t_p, self.alpha))

    def slope(self, phase):
        """dQ/dphase over ``phase`` (cycles); smallest value −1, at t_e."""
        phase = np.mod(phase, 1.0)
        rest = np.exp(-self.epsilon * (1 - self.t_e))
        after = np.clip(phase - self.t_e, 0.0, None)
        back = -(np.exp(-self.epsilon * after) - rest) / (self.epsilon * self.t_a)
        scale = -1.0 / (np.exp(self.alpha * self.t_e) * np.sin(self.omega * self.t_e))
        return np.where(phase <= self.t_e, scale * np.exp(self.alpha * phase) * np.sin(self.omega * phase), back)

    def flow(self, phase):
        """Flow over ``phase`` (cycles); smallest value 0 (just before and after the period's end)."""
        phase = np.mod(phase, 1.0)
        after = np.clip(phase - self.t_e, 0.0, None)
        e, rest = self.epsilon, np.exp(-self.epsilon * (1 - self.t_e))
        back = -((1 - np.exp(-e * after)) / e - rest * after) / (e * self.t_a)
        opening = self._open_flow(np.minimum(phase, self.t_e), self.alpha)
        return np.where(phase <= self.t_e, opening, opening + back)

    def _open_flow(self, t, alpha):
        """∫ of the opening branch from 0 to t, scaled to −1 at t_e."""
        w = self.omega
        scale = -1.0 / (np.exp(alpha * self.t_e) * np.sin(w * self.t_e))
        return scale * (np.exp(alpha * t) * (alpha * np.sin(w * t) - w * np.cos(w * t)) + w) / (alpha**2 + w**2)

    def _return_area(self) -> float:
        e, left = self.epsilon, 1 - self.t_e
        rest = np.exp(-e * left)
        return -((1 - rest) / e - rest * left) / (e * self.t_a)


def signals_from(area_m2: np.ndarray, rate_hz: float = RATE_HZ, **changes) -> Signals:
    """Signals around a given area: flow at 40 m/s, sound as its derivative, contact while the area is small."""
    flow = 40.0 * area_m2
    sound = np.gradient(flow) * rate_hz * 1.14 / (4 * np.pi * 0.3)
    touching = np.clip(0.2 - area_m2 / max(area_m2.max(), 1e-12), 0.0, None) / 0.2
    default = Signals(
        sample_rate_hz=rate_hz,
        glottal_area_m2=area_m2,
        glottal_flow_m3_s=flow,
        lip_pressure_pa=10.0 * sound,
        far_pressure_pa=sound,
        contact_pressure_max_pa=2000.0 * touching,
        contact_location=np.where(touching > 0.0, 0.5, np.nan),
        contact_area_m2=30 * MM2 * touching,
        subglottal_pressure_pa=1000.0,
        length_m=15.85e-3,
        strain=0.057,
        glottal_half_angle_rad=0.01,
        gap_m=2 * 15.85e-3 * np.tan(0.01),
        medial_area_m2=15.85e-3 * 4.86e-3,
    )
    return replace(default, **changes)
