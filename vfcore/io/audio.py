"""From pressure to a sound file: 48 kHz, 16-bit, mono.

Resampling keeps pressure in Pa. Everything up to 0.42 of the lower of the two rates passes within 0.01 dB (11.8 kHz
from 28 kHz, 20.1 kHz from faster ones); images and aliases, from 0.5 of it on, are at least 80 dB down. A ratio of
small whole numbers is done in one polyphase filter; any other first goes to a whole multiple of the input rate and
is then read at the exact instants from a cubic spline.

Levels: dBFS is relative to full scale. A normalised file peaks at −3 dBFS and says by which gain; a file that is
not normalised has 0 dBFS = 6325 Pa, a peak of 170 dB re 20 µPa, so that files can be compared by ear (pressures at
the lips of this model peak near 1.6 kPa for a narrow mouth at 1 kPa of lung pressure).
"""

import io
import math
import wave
from fractions import Fraction
from functools import lru_cache

import numpy as np

from vfcore.errors import ParameterError
from vfcore.spec.fields import check_number

AUDIO_RATE_HZ = 48000
FULL_SCALE_PA = 20e-6 * 10 ** (170 / 20)
PEAK_DBFS = -3.0
FADE_S = 0.010

PASS_BAND = 0.42  # of the lower rate
STOP_BAND = 0.5
STOP_BAND_DB = 85.0  # designed; 80 promised
SPLINE_RATE_HZ = 8 * AUDIO_RATE_HZ  # a cubic spline leaves images of 24 kHz below −90 dB here
LARGEST_FACTOR = 10_000
RATE_LIMITS_HZ = (1e3, 1e8)
_PCM_PEAK = 32767


def render(pressure_pa: np.ndarray, sample_rate_hz: float, rate_hz: float = AUDIO_RATE_HZ) -> np.ndarray:
    """Pressure, shape (n,) at any ``sample_rate_hz``, as audio in Pa at ``rate_hz``; the first samples coincide.

    ParameterError when the pressure is not a finite waveform or a rate is out of range.
    """
    check_number("sample_rate_hz", sample_rate_hz, *RATE_LIMITS_HZ, "Hz")
    check_number("rate_hz", rate_hz, *RATE_LIMITS_HZ, "Hz")
    pressure = _waveform("pressure_pa", pressure_pa)
    ratio = Fraction(rate_hz / sample_rate_hz).limit_denominator(LARGEST_FACTOR)
    exact = abs(ratio * sample_rate_hz / rate_hz - 1) < 1e-9 and ratio.numerator <= LARGEST_FACTOR
    if exact:
        return _band_limited(pressure, ratio.numerator, ratio.denominator, min(1.0, float(ratio)))
    fast = SPLINE_RATE_HZ * max(1, rate_hz / AUDIO_RATE_HZ)
    if sample_rate_hz < fast:
        up, down = math.ceil(fast / sample_rate_hz), 1
    else:  # an odd divisor: 2/2 would be taken for 1/1, which filters nothing
        up, down = 2, (math.floor(2 * sample_rate_hz / fast) - 1) | 1
    dense = _band_limited(pressure, up, down, min(1.0, rate_hz / sample_rate_hz))
    count = math.ceil(pressure.size * rate_hz / sample_rate_hz)
    instants = np.arange(count) * (sample_rate_hz * up / down / rate_hz)
    from scipy.ndimage import map_coordinates

    return map_coordinates(dense, instants[np.newaxis, :], order=3, mode="nearest")


def to_wav_bytes(audio_pa: np.ndarray, normalize: bool = True, phonating: bool = True) -> tuple[bytes, float]:
    """A WAV file of ``audio_pa`` (48 kHz, Pa, shape (n,)) and its gain in full scales per Pa.

    The mean is removed and both ends fade over 10 ms (raised cosine). With ``normalize`` the peak is −3 dBFS,
    otherwise the gain is 1/FULL_SCALE_PA. A run that does not phonate, or has no sound, gives exact zeros and gain 0.
    ParameterError when the audio is not a finite waveform, or would clip without normalisation.
    """
    audio = _waveform("audio_pa", audio_pa)
    if not phonating:
        return _pcm16(np.zeros(audio.size)), 0.0
    envelope = fade(audio.size)
    faded = envelope * (audio - np.sum(envelope * audio) / np.sum(envelope))
    peak = float(np.abs(faded).max())
    if peak == 0:
        return _pcm16(faded), 0.0
    if normalize:
        gain = 10 ** (PEAK_DBFS / 20) / peak
    elif peak <= FULL_SCALE_PA:
        gain = 1 / FULL_SCALE_PA
    else:
        raise ParameterError(
            "normalize", f"false, but the sound's peak of {peak:.0f} Pa would clip",
            f"true, or a sound of at most {FULL_SCALE_PA:.0f} Pa",
        )  # fmt: skip
    return _pcm16(faded * gain), gain


def fade(count: int) -> np.ndarray:
    """Envelope, shape (count,): raised cosines of 10 ms (or half of a shorter sound) from and to nearly 0, else 1."""
    length = min(round(FADE_S * AUDIO_RATE_HZ), count // 2)
    rise = 0.5 - 0.5 * np.cos(np.pi * (np.arange(length) + 0.5) / max(length, 1))
    return np.concatenate([rise, np.ones(count - 2 * length), rise[::-1]])


def _band_limited(waveform: np.ndarray, up: int, down: int, band: float) -> np.ndarray:
    """Polyphase resampling by up/down, keeping ``band`` (0 to 1) of the input's own band."""
    from scipy.signal import resample_poly  # half a second to import: not before there is sound to make

    return resample_poly(waveform, up, down, window=low_pass(up, band))


@lru_cache(maxsize=16)
def low_pass(up: int, band: float) -> np.ndarray:
    """Linear-phase Kaiser low-pass at ``up`` times the input rate, stop band from half of ``band``'s rate."""
    from scipy.signal import firwin, kaiserord

    lower_rate = band / up  # in units of the rate the filter runs at
    count, beta = kaiserord(STOP_BAND_DB, 2 * (STOP_BAND - PASS_BAND) * lower_rate)
    return firwin(2 * (count // 2) + 1, (STOP_BAND + PASS_BAND) * lower_rate, window=("kaiser", beta))


def _waveform(path: str, values: np.ndarray) -> np.ndarray:
    waveform = np.asarray(values, dtype=np.float64)
    if waveform.ndim != 1 or waveform.size == 0:
        raise ParameterError(path, f"shape {waveform.shape} is not a waveform", "one value per sample")
    if not np.isfinite(waveform).all():
        raise ParameterError(path, "the waveform has values that are not finite", "finite values, Pa")
    return waveform


def _pcm16(samples: np.ndarray) -> bytes:
    buffer = io.BytesIO()
    with wave.open(buffer, "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(AUDIO_RATE_HZ)
        file.writeframes(np.round(samples * _PCM_PEAK).astype("<i2").tobytes())
    return buffer.getvalue()
