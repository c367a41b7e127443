"""The wave whose repetition shows phonation, its cycles and f_o: the glottal area, else the flow, else the sound.

The area is the vibration itself. The flow follows it, and the same bounds hold for its shape. The pressure of a simple
source is the slope of the flow through the mouth, so a sound is integrated to a wave that is proportional to that flow:
low harmonics prevail in it, and the vocal tract's resonances repeat less within a cycle than they do in the pressure.
What they still do is why a sound has bounds of its own.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import fft

from vfcore.measures.pitch import LOWEST_RATE_HZ


@dataclass(frozen=True, slots=True)
class Bounds:
    """Which waves of one kind count as phonation, as repeating and as alike; ``name`` and ``unit`` for sentences.

    ``unit_per_si``: how many ``unit`` are one SI unit. ``swing``: peak-to-peak amplitude.

    - ``min_swing``: the smallest swing that could be audible, SI unit.
    - ``min_relative_swing``: the smallest swing over the mean; 0 for a wave without a mean.
    - ``max_difference``: the largest root-mean-square difference between the wave and its copy one pattern later, over
      its rms, of a wave that repeats.
    - ``alike``: the autocorrelation from which cycles of one pattern count as alike.
    - ``followed``: the cycle of an irregular voice is the first peak of the autocorrelation that is ALIKE high and has
      this share of the highest.
    """

    name: str
    unit: str
    unit_per_si: float
    none_at_all: str
    min_swing: float
    min_relative_swing: float
    max_difference: float
    alike: float
    followed: float


# A nearly periodic voice ("type 1") differs from cycle to cycle by less than 5 % (Titze 1995).
MAX_CYCLE_DIFFERENCE = 0.05
# For a pattern of two, r at half the pattern is the share of the energy in the harmonics of the visible rate minus the
# share in those between, so 1/3 means twice the energy: for a triangular area, amplitudes in a ratio down to 1 : 0.3.
# Below it the smaller is a second bump of one cycle.
ALIKE = 1.0 / 3.0
# A swing below 5 % of the mean area, or flow, leaves the flow practically steady: breath, not voice.
MIN_RELATIVE_SWING = 0.05
# 0.1 mm² is 1 % of an ordinary peak area of 10 mm², or 7 µm of gap over a 15 mm glottis. At 1 kPa it modulates the
# flow by 4 mL/s; as a simple source at 150 Hz that is 26 dB at 0.3 m, below the softest voice (about 40 dB).
MIN_AREA_SWING_M2 = 1e-7
# What that area does to the flow at 1 kPa.
MIN_FLOW_SWING_M3_S = 4e-6
# Peak to peak of a sine of 26 dB re 20 µPa, the level at 0.3 m of that flow.
MIN_SOUND_SWING_PA = 2.0 * 2.0**0.5 * 20e-6 * 10.0 ** (26.0 / 20.0)
# A microphone adds the noise of breath and room. A healthy sustained vowel has a harmonics-to-noise ratio of 20 dB and
# more (Boersma 1993): r = 0.99, a difference of √(2 · 0.01).
MAX_SOUND_DIFFERENCE = 0.1415
# A resonance near a harmonic makes parts of one cycle alike: r reaches 0.9 at half a cycle where the first resonance is
# twice f_o. So in a sound only cycles that are nearly equal count as several; an alternation below the difference above
# is not recognised, and a strong one is taken for one long cycle, of the same f_o.
SOUND_ALIKE = 0.9
# For the same reason a first peak far below the highest is a part of a cycle. Unequal cycles have 0.8 of it and more;
# parts of a cycle 0.6 and less where no resonance is at a harmonic.
SOUND_FOLLOWED = 0.75

AREA_BOUNDS = Bounds(
    "glottal area", "mm²", 1e6, "the glottis stays closed",
    MIN_AREA_SWING_M2, MIN_RELATIVE_SWING, MAX_CYCLE_DIFFERENCE, ALIKE, 0.0,
)  # fmt: skip
FLOW_BOUNDS = Bounds(
    "glottal flow", "mL/s", 1e6, "no air flows",
    MIN_FLOW_SWING_M3_S, MIN_RELATIVE_SWING, MAX_CYCLE_DIFFERENCE, ALIKE, 0.0,
)  # fmt: skip
SOUND_BOUNDS = Bounds(
    "sound", "Pa", 1.0, "there is no sound",
    MIN_SOUND_SWING_PA, 0.0, MAX_SOUND_DIFFERENCE, SOUND_ALIKE, SOUND_FOLLOWED,
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class Vibration:
    """The measured part of the wave that is judged, shape (n,), float64, SI unit: area, flow or pressure."""

    wave: np.ndarray
    sample_rate_hz: float
    bounds: Bounds

    @cached_property
    def source(self) -> np.ndarray:
        """The wave in which cycles are sought, shape (n,): the area, the flow, or the sound integrated."""
        return integrated(self.wave, self.sample_rate_hz) if self.bounds is SOUND_BOUNDS else self.wave


def integrated(pressure_pa: np.ndarray, sample_rate_hz: float) -> np.ndarray:
    """∫ p dt of a pressure, shape (n,), Pa s, without delay and without what is slower than LOWEST_RATE_HZ.

    The spectrum is multiplied by 1/(j2πf) · f²/(f² + f_c²), which reaches 8 ms to either side.
    """
    x = np.asarray(pressure_pa, dtype=np.float64)
    size = fft.next_fast_len(len(x) + round(sample_rate_hz / LOWEST_RATE_HZ), real=True)
    spectrum = fft.rfft(x - x.mean(), size)
    f = np.arange(len(spectrum)) * (sample_rate_hz / size)
    return fft.irfft(spectrum * (-1j / (2.0 * np.pi) * f / (f**2 + LOWEST_RATE_HZ**2)), size)[: len(x)]
