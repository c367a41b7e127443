"""The signals that are measured; nothing here knows the solver."""

from collections.abc import Set
from dataclasses import dataclass, fields
from math import isfinite
from typing import Any, NamedTuple, cast

import numpy as np

from vfcore.errors import ParameterError

#: The waves of ``Signals``, and what a sentence calls each.
WAVES = {
    "glottal_area_m2": "the glottal area",
    "glottal_flow_m3_s": "the glottal flow",
    "lip_pressure_pa": "the pressure at the lips",
    "far_pressure_pa": "the sound at a distance",
    "contact_pressure_max_pa": "the contact pressure",
    "contact_location": "the place of the contact",
    "contact_area_m2": "the contact area",
}
#: The numbers of ``Signals`` that may be left out, likewise.
NUMBERS = {
    "far_distance_m": "the distance of the microphone",
    "subglottal_pressure_pa": "the subglottal pressure",
    "length_m": "the length of the folds",
    "strain": "the strain of the folds",
    "glottal_half_angle_rad": "the glottal half-angle",
    "gap_m": "the posterior gap",
    "medial_area_m2": "the area of the medial surface",
}
#: Names for one or another: given where one of their members is, and then the first of them is read.
SOUND, VIBRATION = "sound", "vibration"
ALTERNATIVES = {
    SOUND: ("lip_pressure_pa", "far_pressure_pa"),
    VIBRATION: ("glottal_area_m2", "glottal_flow_m3_s", "far_pressure_pa", "lip_pressure_pa"),
}
#: What each name, of a signal or of alternatives, is called in a sentence.
PHRASES = WAVES | NUMBERS | {SOUND: "a sound", VIBRATION: "a glottal area, a flow or a sound"}
MAY_BE_NAN = ("contact_location",)
MIN_SAMPLES = 16
MIN_SAMPLE_RATE_HZ = 100.0  # slower sampling shows no cycle of the slowest voices
READ_BEFORE_S = 0.02  # before the measured part, by slopes and minima at its edge: many times what they need


class Sound(NamedTuple):
    """Radiated pressure at the lips and at a distance, Pa; full waves, of which the measured part is read."""

    lip_pressure_pa: np.ndarray
    far_pressure_pa: np.ndarray


@dataclass(frozen=True, slots=True, eq=False)
class Signals:
    """Waves, uniformly sampled, and the numbers that belong to them; None for what is not known.

    Every wave has shape ``(n,)`` and may be float32 or float64; an array is not copied, a list becomes one. The
    measures use the part from sample ``window_start`` on, so that the onset transient is left out.

    - ``glottal_area_m2``: minimum glottal area A_g,min(t), m².
    - ``glottal_flow_m3_s``: glottal flow rate Q_g(t), m³/s.
    - ``lip_pressure_pa``: radiated pressure at the lips, Pa.
    - ``far_pressure_pa``: free-field pressure at ``far_distance_m`` from the mouth, taken as a simple source, Pa.
    - ``contact_pressure_max_pa``: largest contact pressure over the medial surface at each time, Pa; 0 without contact.
    - ``contact_location``: x/L of that largest pressure, 0 anterior, 1 posterior; NaN without contact.
    - ``contact_area_m2``: area of the medial surface in contact, m².
    - ``gap_m``: full distance between the posterior ends of the vibrating folds at rest, 2 L tan θ_g, m.
    - ``medial_area_m2``: area of one medial surface, L·b, m².
    - ``measured_from``: first sample of the measured part; None: the middle, so that the last half is measured.

    Raises ParameterError for waves of unequal length, values that are not finite, and a sample rate below 100 Hz.
    """

    sample_rate_hz: float
    glottal_area_m2: np.ndarray | None = None
    glottal_flow_m3_s: np.ndarray | None = None
    lip_pressure_pa: np.ndarray | None = None
    far_pressure_pa: np.ndarray | None = None
    contact_pressure_max_pa: np.ndarray | None = None
    contact_location: np.ndarray | None = None
    contact_area_m2: np.ndarray | None = None
    subglottal_pressure_pa: float | None = None
    length_m: float | None = None
    strain: float | None = None
    glottal_half_angle_rad: float | None = None
    gap_m: float | None = None
    medial_area_m2: float | None = None
    far_distance_m: float | None = 0.3
    air_density_kg_m3: float = 1.14
    sound_speed_m_s: float = 350.0
    measured_from: int | None = None

    def __post_init__(self) -> None:
        for name in WAVES:
            wave = getattr(self, name)
            if wave is not None and not isinstance(wave, np.ndarray):
                object.__setattr__(self, name, _array(f"signals.{name}", wave))
        given = [(name, wave) for name in WAVES if (wave := getattr(self, name)) is not None]
        n = np.size(given[0][1]) if given else MIN_SAMPLES
        if n < MIN_SAMPLES:
            raise ParameterError(f"signals.{given[0][0]}", f"{n} samples are too few to measure",
                                 f"at least {MIN_SAMPLES}")  # fmt: skip
        for name, wave in given:
            path = f"signals.{name}"
            if np.shape(wave) != (n,):
                raise ParameterError(path, f"has shape {np.shape(wave)}", f"({n},), one value per sample")
            if name not in MAY_BE_NAN and not _is_finite(wave):
                raise ParameterError(path, "is not finite everywhere", "finite numbers")
        for name in _ALL_NUMBERS:
            value = getattr(self, name)
            if value is not None and not isfinite(value):
                raise ParameterError(f"signals.{name}", "is not finite", "a finite number")
        if self.sample_rate_hz < MIN_SAMPLE_RATE_HZ:
            raise ParameterError("signals.sample_rate_hz", f"{self.sample_rate_hz:g} Hz is too low",
                                 f"at least {MIN_SAMPLE_RATE_HZ:g} Hz")  # fmt: skip
        if self.measured_from is not None and not 0 <= self.measured_from < max(n, 1):
            raise ParameterError("signals.measured_from", f"{self.measured_from} is no sample", f"0 to {n - 1}")

    @classmethod
    def of_sound(
        cls,
        pressure_pa: np.ndarray,
        rate_hz: float,
        *,
        distance_m: float | None = None,
        measured_from: int | None = None,
    ) -> "Signals":
        """The signals of a sound alone, shape (n,), Pa at a microphone ``distance_m`` from the mouth.

        Without the distance there is no level. All else depends on the shape of the wave alone, so a recording that
        is not calibrated may be given in other units, with a full scale of about 1.
        """
        return cls(
            float(rate_hz), far_pressure_pa=pressure_pa, far_distance_m=distance_m,
            measured_from=measured_from,
        )  # fmt: skip

    @property
    def samples(self) -> int:
        """Length n of the waves; 0 where there is none."""
        return next((len(wave) for name in WAVES if (wave := getattr(self, name)) is not None), 0)

    @property
    def window_start(self) -> int:
        """First sample of the part that is measured."""
        return window_start(self.samples) if self.measured_from is None else self.measured_from

    @property
    def given(self) -> frozenset[str]:
        """Names of the waves and numbers that are given, and of the alternatives of which one is given."""
        return with_alternatives({name for name in (*WAVES, *NUMBERS) if getattr(self, name) is not None})

    def wave(self, name: str) -> np.ndarray:
        """The wave of that name, which must be given."""
        return cast(np.ndarray, self._needed(name))

    def number(self, name: str) -> float:
        """The number of that name, which must be given."""
        return cast(float, self._needed(name))

    def _needed(self, name: str) -> np.ndarray | float:
        value = getattr(self, name)
        if value is None:
            raise LookupError(f"signals.{name} is not given")
        return value


_ALL_NUMBERS = tuple(field.name for field in fields(Signals) if field.name not in (*WAVES, "measured_from"))


def with_alternatives(names: Set[str]) -> frozenset[str]:
    """``names`` of signals, with those of ALTERNATIVES of which one member is among them."""
    found = [name for name, members in ALTERNATIVES.items() if not names.isdisjoint(members)]
    return frozenset({*names, *found})


def missing_sentence(names: list[str]) -> str:
    """Why a measure has no value: it needs the signals ``names``, one or more."""
    phrases = [PHRASES[name] for name in names]
    listed = " and ".join([", ".join(phrases[:-1]), phrases[-1]] if len(phrases) > 1 else phrases)
    return f"Needs {listed}, which {'is' if len(phrases) == 1 else 'are'} not given."


def _array(path: str, wave: Any) -> np.ndarray:
    """A wave given as a list or another sequence."""
    try:
        return np.asarray(wave, dtype=float)
    except (TypeError, ValueError) as error:
        raise ParameterError(path, "is not a row of numbers", "an array or a list of numbers") from error


def _is_finite(value: np.ndarray) -> bool:
    """Whether all are finite: the sum shows it, unless it is itself beyond the largest number."""
    with np.errstate(over="ignore", invalid="ignore"):
        return bool(np.isfinite(value.sum()) or np.isfinite(value).all())


def window_start(samples: int) -> int:
    """First sample of the last half of a run."""
    return samples // 2


def unused_samples(samples: int, sample_s: float) -> int:
    """How many of the first samples of a run no measure reads, of other waves than the sound."""
    return max(0, window_start(samples) - round(READ_BEFORE_S / sample_s))
