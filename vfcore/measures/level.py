"""Sound pressure level and efficiency."""

from math import log10, pi

import numpy as np

from vfcore.kernels.level import rms_about_mean
from vfcore.measures.cycles import plain
from vfcore.measures.measure import Missing

REFERENCE_PRESSURE_PA = 20e-6


def rms_pa(pressure_pa: np.ndarray) -> float:
    """Root-mean-square of ``pressure_pa``, shape (n,), about its mean, Pa."""
    return rms_about_mean(plain(pressure_pa))


def sound_pressure_level_db(rms: float) -> float | Missing:
    """Level of a root-mean-square, Pa, in dB re 20 µPa."""
    if rms == 0.0:
        return Missing("There is no sound: the pressure does not change.")
    return 20.0 * log10(rms / REFERENCE_PRESSURE_PA)


def radiated_power_w(rms: float, distance_m: float, density_kg_m3: float, speed_m_s: float) -> float:
    """Power of a simple source in free space whose ``rms``, Pa, at ``distance_m`` is given: 4πr² p_rms² / (ρc), W."""
    return 4.0 * pi * distance_m**2 * rms**2 / (density_kg_m3 * speed_m_s)


def efficiency(radiated_w: float, subglottal_pressure_pa: float, mean_flow_m3_s: float) -> float | Missing:
    """Radiated power over aerodynamic power P_s Q̄."""
    aerodynamic_w = subglottal_pressure_pa * mean_flow_m3_s
    if aerodynamic_w <= 0.0:
        return Missing("No aerodynamic power: the subglottal pressure or the mean flow is not positive.")
    return radiated_w / aerodynamic_w


def decibels(ratio: float | Missing) -> float | Missing:
    """A power ratio in dB."""
    if isinstance(ratio, Missing):
        return ratio
    return 10.0 * log10(ratio) if ratio > 0.0 else Missing("There is no radiated power.")
