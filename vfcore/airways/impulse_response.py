"""The tract as a linear filter: its impulse response, and one convolution per run.

With one-way coupling the lips' pressure and flow are linear in the glottal flow, so the stepped tube need run only
once per tract. With h_j its response to a unit flow at step 0 and τ = δ/c, a flow known between its samples gives

    y(t) = Σ_j h_j Q_g(t − jτ).

A run's flow q_k comes at its own step T and is read between its samples by a sinc in Kaiser's window, a samples to
either side, whose weights are scaled so that a steady flow stays what it is:

    Q_g(t) = Σ_k q_k κ(t/T − k)    ⇒    y(mT) = Σ_k g_{m−k} q_k,    g_l = Σ_j h_j κ(l − jτ/T).

So each h_j is shared among the 2a samples around jτ/T, and one formula serves every step: T = 5τ (folding five
phases into one), T = τ (h itself), T = τ/4 (four interleaved tubes) and anything else. It equals stepping the tube
with the interpolated flow. At 28 kHz a voice pulse comes out within 0.08 dB up to 10 kHz of the same pulse at the
paper's step (Keys' cubic convolution would lose 1 dB at 8 kHz). The kernel reads a − 1 later samples, which must
not take longer than the sound's travel to the lips: a = 6, less where a step is longer than a fifth of the travel. The
flow is 0 before its first sample: a run that starts with flow starts with a jump.

The far pressure is that of a simple source in free field, p = ρ/(4πr) dU/dt (Morse & Ingard 1968), without the
travel time from the lips; dU/dt by the fourth-order central difference at τ (at 8 kHz within 0.1 %).
"""

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

from vfcore.airways.resonances import poles
from vfcore.airways.tract import LipOutput, Tract, stepped
from vfcore.errors import ParameterError
from vfcore.spec.fields import check_number
from vfcore.spec.simulation import STEP_LIMITS_S

FAR_DISTANCE_M = 0.3  # the usual microphone distance in the clinic
LEFT_OUT_ENERGY = 1e-20  # of the response: a long run agrees with the stepped tube to 1e-9
LONGEST_RESPONSE = 2_000_000
EVENLY = 256  # transforms of lengths with this factor take a tenth less time than those of the next fast length
LONGEST_BLOCK = 50_000  # samples per transform: 1 s of the default step in one, and a bounded memory
#: Samples to either side that the flow is read from, at most, and the window's shape. Of half-widths 4 to 8 and shapes
#: 5 to 10 this pair is nearest to the paper's step from 0 to 10 kHz and leaves no image of a low tone.
HALF_WIDTH, KAISER_BETA = 6, 10.0
_CENTRAL_DIFFERENCE = np.array([-1, 8, 0, -8, 1]) / 12  # y_{j+2} … y_{j−2}, as a convolution kernel


class Pressures(NamedTuple):
    """Sound of one run, shape (n,), or of several, (runs, n): pressure at the lips and at FAR_DISTANCE_M, Pa."""

    lip_pressure_pa: np.ndarray
    far_pressure_pa: np.ndarray


class Radiated(NamedTuple):
    """The same with the flow at the lips, m³/s."""

    lip_pressure_pa: np.ndarray
    mouth_flow_m3_s: np.ndarray
    far_pressure_pa: np.ndarray


def response_length(tract: Tract) -> int:
    """Steps after which the slowest resonance has LEFT_OUT_ENERGY of its energy left.

    ParameterError when the tract hardly loses energy (no attenuation and an open end).
    """
    decay = -2 * math.log(np.abs(poles(tract)).max())  # of energy, per step
    steps = math.log(1 / LEFT_OUT_ENERGY) / decay if decay > 0 else math.inf
    if steps > LONGEST_RESPONSE:
        raise ParameterError("tract", "the tract rings without end", "attenuation above 0, or piston radiation")
    return len(tract.areas_m2) + math.ceil(steps)


@lru_cache(maxsize=32)
def impulse_response(tract: Tract) -> LipOutput:
    """Lip pressure and mouth flow after a unit glottal flow at step 0, per section travel; read-only."""
    impulse = np.zeros(response_length(tract))
    impulse[0] = 1.0
    response = stepped(impulse, tract)
    for waveform in response:
        waveform.flags.writeable = False
    return response


def _weights(share: np.ndarray, half_width: int) -> np.ndarray:
    """κ at the 2a samples, (2a, n) from 1 − a on, around instants ``share`` (n,) of a sample behind sample 0."""
    distance = np.arange(1 - half_width, half_width + 1)[:, None] - share
    inside = np.maximum(1.0 - (distance / half_width) ** 2, 0.0)
    kernel = np.sinc(distance) * np.i0(KAISER_BETA * np.sqrt(inside))
    return kernel / kernel.sum(axis=0)


@lru_cache(maxsize=16)
def response_at(tract: Tract, time_step_s: float) -> np.ndarray:
    """g for lip pressure, mouth flow and far pressure, shape (3, taps)."""
    lip_pressure, mouth_flow = impulse_response(tract)
    flow_rate = np.convolve(mouth_flow, _CENTRAL_DIFFERENCE)[2:-2] / tract.section_travel_s
    far_pressure = tract.density_kg_m3 / (4 * np.pi * FAR_DISTANCE_M) * flow_rate
    place = np.arange(lip_pressure.size) * (tract.section_travel_s / time_step_s)
    before = np.floor(place).astype(np.int64)
    share = place - before
    arrives = len(tract.areas_m2) - len(_CENTRAL_DIFFERENCE) // 2  # in the far pressure, whose rate reads later samples
    early = min(HALF_WIDTH - 1, max(1, int(before[arrives])))
    taps = before[-1] + 2 * (early + 1)
    folded = np.zeros((3, taps))
    for nth, weight in enumerate(_weights(share, early + 1)):
        for row, response in zip(folded, (lip_pressure, mouth_flow, far_pressure), strict=True):
            row += np.bincount(before + nth, response * weight, taps)
    return folded[:, early:]  # the samples before are empty: nothing reaches the lips within ``early`` steps


@lru_cache(maxsize=16)
def _spectra_at(tract: Tract, time_step_s: float, length: int, precision: str) -> np.ndarray:
    """Spectra of g, zero-padded to ``length`` samples, shape (3, length//2 + 1)."""
    return rfft(response_at(tract, time_step_s).astype(precision), length, axis=1)


def radiate(flow_m3_s: np.ndarray, time_step_s: float, tract: Tract, first: int = 0) -> Radiated:
    """Sound of a glottal flow, shape (n,) at ``time_step_s``, at the same times as the flow from sample ``first`` on.

    The waves from ``first`` on are the same, bit for bit, whether or not the part before it is computed too, in a call
    of its own.

    ParameterError when the flow is not a finite waveform, or the step is out of range or longer than the sound's
    travel through the tract.
    """
    flow = np.asarray(flow_m3_s, dtype=np.float64)
    if flow.ndim != 1 or flow.size == 0:
        raise ParameterError("flow_m3_s", f"shape {flow.shape} is not a waveform", "one value per time step")
    return Radiated(*(waves[0] for waves in radiate_each(flow[None], time_step_s, tract, first)))


def radiate_each(flows_m3_s: np.ndarray, time_step_s: float, tract: Tract, first: int = 0) -> Radiated:
    """The same of several flows, shape (runs, n), transformed in one call in the precision they have."""
    sound = _convolved(flows_m3_s, time_step_s, tract, first, slice(None))
    return Radiated(sound[:, 0], sound[:, 1], sound[:, 2])


def pressures_of_each(flows_m3_s: np.ndarray, time_step_s: float, tract: Tract, first: int = 0) -> Pressures:
    """``radiate_each`` without the flow at the lips, in two thirds of the time."""
    sound = _convolved(flows_m3_s, time_step_s, tract, first, slice(None, None, 2))
    return Pressures(sound[:, 0], sound[:, 1])


def _convolved(flows_m3_s: np.ndarray, time_step_s: float, tract: Tract, first: int, rows: slice) -> np.ndarray:
    """Flows, shape (runs, n), with the ``rows`` of ``response_at``: (runs, rows, n − first)."""
    travel = len(tract.areas_m2) * tract.section_travel_s
    check_number("time_step_s", time_step_s, STEP_LIMITS_S[0], min(travel, STEP_LIMITS_S[1]), "s")
    if not np.isfinite(flows_m3_s).all():
        raise ParameterError("flow_m3_s", "the flow has values that are not finite", "finite values, m³/s")
    precision = flows_m3_s.dtype
    taps = response_at(tract, float(time_step_s)).shape[1]
    runs, samples = flows_m3_s.shape
    count = samples - first
    block = min(count, max(LONGEST_BLOCK, 2 * taps))
    length = EVENLY * next_fast_len(-(-(block + taps - 1) // EVENLY), real=True)
    spectra = _spectra_at(tract, float(time_step_s), length, precision.name)
    hop = length - taps + 1
    sound = np.empty((runs, len(spectra[rows]), count), precision)
    for start in range(0, count, hop):  # overlap-save: a block reads the flow as far back as the response reaches
        begin, end = first + start - taps + 1, min(first + start + hop, samples)
        part = np.zeros((runs, length), precision)
        part[:, max(-begin, 0) : end - begin] = flows_m3_s[:, max(begin, 0) : end]
        spectrum = rfft(part, overwrite_x=True)[:, None]
        parts = irfft(spectrum * spectra[rows], length, overwrite_x=True)
        sound[:, :, start : start + hop] = parts[:, :, taps - 1 : taps - 1 + end - first - start]
    return sound
