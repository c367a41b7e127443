"""The tract in the frequency domain: its transfer function, its poles and its formants, glottis closed.

Transfer function by chain matrices. A tube of impedance Z crossed with the factor α has, with Γ = jωτ − ln α,

    P_in = cosh Γ P_out + Z sinh Γ U_out,      U_in = (sinh Γ/Z) P_out + cosh Γ U_out,

applied from the lips (P = Z_rad U) to the glottis. With the radiation impedance at the bilinear frequency
(2/τ) tan(ωτ/2) this is the stepped tube's response exactly; the commensurate tubes make it repeat every 1/(2τ).

Poles are the eigenvalues z of the matrix that takes the waves of a step to those of the next without flow:
resonance frequency arg z/(2πτ), bandwidth −ln|z|/(πτ).
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from vfcore.airways.tract import Tract
from vfcore.errors import ParameterError


class TransferFunction(NamedTuple):
    """Response to glottal flow: lip pressure, Pa·s/m³, and mouth flow, dimensionless; complex, one per frequency."""

    lip_pressure: np.ndarray
    mouth_flow: np.ndarray


class Formants(NamedTuple):
    """Resonances in rising order, Hz, and their −3 dB bandwidths, Hz; both shape (n,)."""

    frequency_hz: np.ndarray
    bandwidth_hz: np.ndarray


def transfer_function(tract: Tract, freqs_hz: np.ndarray) -> TransferFunction:
    """Lip pressure and mouth flow per glottal flow, glottis closed, at ``freqs_hz`` (any shape, Hz)."""
    end, _, flow = _at_the_glottis(tract, freqs_hz)
    return TransferFunction(end / flow, 1 / flow)


def input_impedance(tract: Tract, freqs_hz: ArrayLike) -> np.ndarray:
    """Pressure per flow at the glottal end of the tract, Pa·s/m³, complex; ``freqs_hz`` of any shape, Hz."""
    _, pressure, flow = _at_the_glottis(tract, freqs_hz)
    return pressure / flow


def _at_the_glottis(tract: Tract, freqs_hz: ArrayLike) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Impedance of the far end; pressure and flow at the glottis for unit flow through that end."""
    phase = 2 * np.pi * np.asarray(freqs_hz, dtype=np.float64) * tract.section_travel_s
    end = _end_impedance(tract, phase)
    pressure, flow = end, np.ones(phase.shape, dtype=complex)
    for impedance, transmission in zip(tract.impedance_pa_s_m3[::-1], tract.transmission[::-1], strict=True):
        propagation = 1j * phase - np.log(transmission)
        cosh, sinh = np.cosh(propagation), np.sinh(propagation)
        pressure, flow = cosh * pressure + impedance * sinh * flow, sinh / impedance * pressure + cosh * flow
    return end, pressure, flow


def _end_impedance(tract: Tract, phase: np.ndarray) -> np.ndarray:
    if tract.radiation == "open":
        return np.zeros(phase.shape, dtype=complex)
    if tract.radiation == "lungs":
        reflection = tract.lip_reflection[0]
        return np.full(phase.shape, tract.impedance_pa_s_m3[-1] * (1 + reflection) / (1 - reflection), dtype=complex)
    resistance, inertance = tract.radiation_resistance_inertance
    reactance = 1j * (2 / tract.section_travel_s) * np.tan(phase / 2) * inertance
    return reactance * resistance / (reactance + resistance)


def _step_matrix(tract: Tract) -> np.ndarray:
    """What one step does to (f_0 … f_{N−1}, b_0 … b_{N−1}, m), waves scaled by √A so that scattering is a rotation."""
    count = len(tract.areas_m2)
    lips = 2 * count
    b0, b1, a1 = tract.lip_reflection
    scattering = np.zeros((lips + 1, lips + 1))
    scattering[0, count] = 1  # closed glottis
    for i, r in enumerate(tract.reflection):
        through = np.sqrt(1 - r * r)
        scattering[i + 1, i], scattering[i + 1, count + i + 1] = through, -r
        scattering[count + i, i], scattering[count + i, count + i + 1] = r, through
    scattering[lips - 1, count - 1], scattering[lips - 1, lips] = b0, 1
    scattering[lips, count - 1], scattering[lips, lips] = b1 - a1 * b0, -a1
    return scattering * np.concatenate([tract.transmission, tract.transmission, [1.0]])


@lru_cache(maxsize=64)
def poles(tract: Tract) -> np.ndarray:
    """Poles z of the stepped tract, per section travel, complex, shape (2 sections + 1,); read-only."""
    roots = np.linalg.eigvals(_step_matrix(tract))
    roots.flags.writeable = False
    return roots


def closed_glottis_formants(tract: Tract, n: int = 4) -> Formants:
    """The first ``n`` resonances of the tract with the glottis closed.

    ParameterError when the tract has fewer resonances below its upper frequency 1/(4τ).
    """
    roots = poles(tract)
    travel = tract.section_travel_s
    frequency = np.angle(roots) / (2 * np.pi * travel)
    oscillating = np.flatnonzero((roots.imag > 1e-9) & (frequency < 0.25 / travel))
    if oscillating.size < n:
        raise ParameterError("n", f"the tract has {oscillating.size} resonances", f"1 to {oscillating.size}")
    lowest = oscillating[np.argsort(frequency[oscillating])[:n]]
    return Formants(frequency[lowest], -np.log(np.abs(roots[lowest])) / (np.pi * travel))
