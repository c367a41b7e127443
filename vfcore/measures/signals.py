"""The waveforms a run hands over to be measured; nothing here knows the solver."""

from dataclasses import dataclass, fields
from math import isfinite
from typing import NamedTuple

import numpy as np

from vfcore.errors import ParameterError

WAVES = (
    "time_s",
    "glottal_area_m2",
    "glottal_flow_m3_s",
    "lip_pressure_pa",
    "far_pressure_pa",
    "contact_pressure_max_pa",
    "contact_location",
    "contact_area_m2",
)
MAY_BE_NAN = ("contact_location",)
MIN_SAMPLES = 16
READ_BEFORE_S = 0.02  # before the measured half, by slopes and minima at its edge: many times what they need


class Sound(NamedTuple):
    """Radiated pressure at the lips and at a distance, Pa; full waves, of which the measures read the last half."""

    lip_pressure_pa: np.ndarray
    far_pressure_pa: np.ndarray


@dataclass(frozen=True, slots=True, eq=False)
class Signals:
    """Waveforms of one run, uniformly sampled, and the scalars that belong to them.

    Every wave has shape ``(n,)`` and may be float32 or float64; they are not copied. The measures use the part from
    sample ``window_start`` on, so that the onset transient is left out.

    - ``glottal_area_m2``: minimum glottal area A_g,min(t), m².
    - ``glottal_flow_m3_s``: glottal flow rate Q_g(t), m³/s.
    - ``lip_pressure_pa``: radiated pressure at the lips, Pa; None where the sound is worked out on demand, likewise:
    - ``far_pressure_pa``: free-field pressure at ``far_distance_m`` from the mouth, taken as a simple source, Pa.
    - ``contact_pressure_max_pa``: largest contact pressure over the medial surface at each time, Pa; 0 without contact.
    - ``contact_location``: x/L of that largest pressure, 0 anterior, 1 posterior; NaN without contact.
    - ``contact_area_m2``: area of the medial surface in contact, m².
    - ``gap_m``: full distance between the posterior ends of the vibrating folds at rest, 2 L tan θ_g, m.
    - ``medial_area_m2``: area of one medial surface, L·b, m².
    - ``measured_from``: where the measured part begins in the waves; None: in the middle, the last half of a run.

    Raises ParameterError for waves of unequal length, or with values that are not finite.
    """

    sample_rate_hz: float
    time_s: np.ndarray
    glottal_area_m2: np.ndarray
    glottal_flow_m3_s: np.ndarray
    lip_pressure_pa: np.ndarray | None
    far_pressure_pa: np.ndarray | None
    contact_pressure_max_pa: np.ndarray
    contact_location: np.ndarray
    contact_area_m2: np.ndarray
    subglottal_pressure_pa: float
    length_m: float
    strain: float
    glottal_half_angle_rad: float
    gap_m: float
    medial_area_m2: float
    far_distance_m: float = 0.3
    air_density_kg_m3: float = 1.14
    sound_speed_m_s: float = 350.0
    measured_from: int | None = None

    def __post_init__(self):
        n = len(self.time_s)
        if n < MIN_SAMPLES:
            raise ParameterError("signals.time_s", f"{n} samples are too few to measure", f"at least {MIN_SAMPLES}")
        for name in WAVES:
            wave, path = getattr(self, name), f"signals.{name}"
            if wave is None and name in Sound._fields:
                continue
            if np.shape(wave) != (n,):
                raise ParameterError(path, f"has shape {np.shape(wave)}", f"({n},), that of time_s")
            if name not in MAY_BE_NAN and not _is_finite(wave):
                raise ParameterError(path, "is not finite everywhere", "finite numbers")
        for name in SCALARS:
            if not isfinite(getattr(self, name)):
                raise ParameterError(f"signals.{name}", "is not finite", "a finite number")
        if self.sample_rate_hz <= 0:
            raise ParameterError("signals.sample_rate_hz", f"{self.sample_rate_hz:g} is not positive", "above 0 Hz")

    @property
    def window_start(self) -> int:
        """First sample of the part that is measured."""
        return window_start(len(self.time_s)) if self.measured_from is None else self.measured_from


SCALARS = tuple(field.name for field in fields(Signals) if field.name not in (*WAVES, "measured_from"))


def _is_finite(value: np.ndarray) -> bool:
    """The sum of a wave tells, unless it is itself beyond the largest number."""
    with np.errstate(over="ignore", invalid="ignore"):
        return bool(np.isfinite(value.sum()) or np.isfinite(value).all())


def window_start(samples: int) -> int:
    """First sample of the last half of a run."""
    return samples // 2


def unread(samples: int, sample_s: float) -> int:
    """How many of the first samples of a run no measure reads, of other waves than the sound."""
    return max(0, window_start(samples) - round(READ_BEFORE_S / sample_s))
