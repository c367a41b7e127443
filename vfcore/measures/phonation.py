"""The phonation state, decided before anything else is measured.

The criterion uses the minimum glottal area in the window only, in this order:

1. amplitude  — the area must move enough to modulate the air flow audibly, else ``none``;
2. steadiness — the vibration must neither die out nor still be building up, else ``none``: a ringing after onset is
   not phonation, and a wave that still grows has not been shown to settle;
3. repetition — the wave must equal itself one lag later to within Titze's bound for a nearly periodic voice.
   If the repeating pattern holds several similar cycles it is ``subharmonic``, else ``periodic``;
   if no lag repeats, ``irregular``.

Closing is not asked for: a glottis that never closes can vibrate perfectly periodically.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import sqrt

import numpy as np

from vfcore.measures.pitch import HIGHEST_RATE_HZ, LOWEST_RATE_HZ, Autocorrelation, Peak, autocorrelation

# 0.1 mm² is 1 % of an ordinary peak area of 10 mm², or 7 µm of gap over a 15 mm glottis. At 1 kPa it modulates the
# flow by 4 mL/s; as a simple source at 150 Hz that is 26 dB at 0.3 m, below the softest voice (about 40 dB).
MIN_AREA_SWING_M2 = 1e-7
# A swing below 5 % of the mean area leaves the flow practically steady: breath, not voice.
MIN_RELATIVE_SWING = 0.05
# The swing is compared over four quarters of the window. It dies out (or still grows) when every quarter has less than
# 93 % of the quarter before (or the reverse). In a half-second window this is a time constant below 1.7 s, longer than
# any in the tissue (milliseconds to tens of milliseconds) unless the posture sits on the threshold itself. Asking for
# three steps in a row spares irregular voices, whose swing wanders, and waves that have merely come down to a plateau.
STEADY_RATIO = 0.93
# A quarter with less than half the swing of another holds part of an onset or an end: averages would mix both.
MIN_QUARTER_RATIO = 0.5
# The same for stretches of 50 ms, one cycle of the slowest pattern. Irregular voices may vary much within so short a
# time, so only near silence counts.
STRETCH_S = 1.0 / LOWEST_RATE_HZ
MIN_STRETCH_RATIO = 0.1
# A nearly periodic voice ("type 1") differs from cycle to cycle by less than 5 % (Titze 1995). Here: root-mean-square
# difference between the wave and its copy one pattern later, over the rms of the wave.
MAX_CYCLE_DIFFERENCE = 0.05
# Cycles count as alike from this autocorrelation on. For a pattern of two, r at half the pattern is the share of the
# energy in the harmonics of the visible rate minus the share in those between, so 1/3 means twice the energy: for a
# triangular area, amplitudes in a ratio down to 1 : 0.3. Below it the smaller is a second bump of one cycle.
ALIKE = 1.0 / 3.0
# The next cycle alike begins at a whole fraction of the pattern, give or take this share of a cycle.
FRACTION_TOLERANCE = 0.1
# Longer patterns cannot be told from irregular voices in half a second.
MAX_CYCLES_PER_PATTERN = 6
# A pattern of several cycles must also repeat this many patterns later: two incommensurate rates may match once.
LATER_PATTERNS = (2, 4)
# Below this autocorrelation no cycle can be followed to the next (Boersma 1993 takes 0.45 as his voicing threshold).
MIN_TRACKABLE = 0.45
# Sustained phonation cannot be judged on less: each quarter must hold at least one cycle of the lowest voices (40 Hz).
MIN_WINDOW_S = 0.1

STATES = ("none", "periodic", "subharmonic", "irregular")


@dataclass(frozen=True, slots=True)
class Phonation:
    """State, the sentence that explains it, and the periods found (samples; None where there is none).

    ``periodicity``: normalised autocorrelation peak at the repeating pattern (for irregular voices: at the cycle).
    ``pattern``: what repeats, the reciprocal of f_o. ``cycle``: one opening and closing; shorter than the pattern by
    the whole factor ``cycles_per_pattern`` in a subharmonic voice, else the same.
    """

    state: str
    explanation: str
    periodicity: float | None = None
    pattern: float | None = None
    cycle: float | None = None
    cycles_per_pattern: int = 1
    correlation: Autocorrelation | None = None


def judge_phonation(
    area_m2: np.ndarray, sample_rate_hz: float, correlate: Callable[[], Autocorrelation] | None = None
) -> Phonation:
    """The phonation state of the minimum glottal area ``area_m2``, shape (n,), m², over one window.

    ``correlate``: called for the area's autocorrelation; None where it is to be worked out here.
    """
    area = np.asarray(area_m2, dtype=np.float64)
    silence = _too_small(area, sample_rate_hz) or _unsteady(area, int(STRETCH_S * sample_rate_hz))
    if silence:
        return Phonation("none", silence)
    correlation = autocorrelation(area) if correlate is None else correlate()
    lag_min = max(int(sample_rate_hz / HIGHEST_RATE_HZ), 2)
    lag_max = min(int(sample_rate_hz / LOWEST_RATE_HZ), len(area) // 3)
    peaks = correlation.peaks(lag_min, lag_max)
    if not peaks:
        return Phonation("none", "No phonation: the glottal area changes but does not vibrate.")
    for peak in peaks:
        if cycle_difference(peak.height) <= MAX_CYCLE_DIFFERENCE:
            peak = correlation.near(peak.lag, 0.02 * peak.lag + 1.0)
            cycle, count = _cycle_in_pattern(peak, peaks)
            if count == 1 or (count <= MAX_CYCLES_PER_PATTERN and _repeats_later(correlation, peak)):
                return _repeating(correlation, peak, cycle, count)
    return _irregular(correlation, peaks)


def cycle_difference(height: float) -> float:
    """Rms difference between the wave and its shifted copy over the rms of the wave, from the autocorrelation."""
    return sqrt(2.0 * max(1.0 - height, 0.0))


def _too_small(area: np.ndarray, sample_rate_hz: float) -> str | None:
    duration = len(area) / sample_rate_hz
    if duration < MIN_WINDOW_S:
        return (
            f"Not judged: the measured half of the run lasts {duration * 1e3:.0f} ms, "
            f"and at least {MIN_WINDOW_S * 1e3:.0f} ms are needed to call phonation sustained."
        )
    last_half = area[len(area) // 2 :]
    swing = float(np.ptp(last_half))
    mean = float(last_half.mean())
    if last_half.max() == 0.0:
        return "No phonation: the glottis stays closed."
    if swing < MIN_AREA_SWING_M2:
        return (
            f"No phonation: the glottal area moves by {swing * 1e6:.2g} mm², "
            f"less than the {MIN_AREA_SWING_M2 * 1e6:g} mm² that would be audible."
        )
    if swing < MIN_RELATIVE_SWING * mean:
        return (
            f"No phonation: the glottal area moves by {100 * swing / mean:.2g} % of its mean, "
            f"less than {100 * MIN_RELATIVE_SWING:g} %; the flow is practically steady."
        )
    return None


def _unsteady(area: np.ndarray, stretch: int) -> str | None:
    swings = _swings(area, len(area) // 4)
    before, after = swings[:-1], swings[1:]
    if np.all(after < STEADY_RATIO * before):
        return _dies_out(swings)
    if np.all(before < STEADY_RATIO * after):
        return _builds_up(swings)
    return _uneven(swings, MIN_QUARTER_RATIO) or _uneven(_swings(area, stretch), MIN_STRETCH_RATIO)


def _uneven(swings: np.ndarray, smallest_ratio: float) -> str | None:
    smallest, largest = int(swings.argmin()), int(swings.argmax())
    if swings[smallest] >= smallest_ratio * swings[largest]:
        return None
    return _dies_out(swings) if smallest > largest else _builds_up(swings)


def _swings(area: np.ndarray, length: int) -> np.ndarray:
    """Largest minus smallest area in consecutive stretches of ``length`` samples, up to the end of the window."""
    count = len(area) // length
    return np.ptp(area[len(area) - count * length :].reshape(count, length), axis=1)


def _dies_out(swings: np.ndarray) -> str:
    return f"No sustained phonation: the vibration dies out, {_change(swings)}."


def _builds_up(swings: np.ndarray) -> str:
    return (
        f"Phonation not settled: the vibration is still building up, {_change(swings)}; "
        "a longer run would show whether it is sustained."
    )


def _change(swings: np.ndarray) -> str:
    first, last = swings[0] * 1e6, swings[-1] * 1e6
    return f"from {first:.3g} to {last:.3g} mm² of area swing in the measured half of the run"


def _cycle_in_pattern(pattern: Peak, peaks: list[Peak]) -> tuple[float, int]:
    """Length of the visible cycle and how many of them make the pattern."""
    for peak in peaks:
        ratio = pattern.lag / peak.lag
        count = round(ratio)
        if count < 2:
            break
        if peak.height >= ALIKE and abs(ratio - count) <= FRACTION_TOLERANCE * count:
            return pattern.lag / count, count
    return pattern.lag, 1


def _repeats_later(correlation: Autocorrelation, pattern: Peak) -> bool:
    later = [k * pattern.lag for k in LATER_PATTERNS if k * pattern.lag < len(correlation.values) - 2]
    return all(
        cycle_difference(correlation.near(lag, 0.05 * pattern.lag).height) <= MAX_CYCLE_DIFFERENCE for lag in later
    )


def _repeating(correlation: Autocorrelation, peak: Peak, cycle: float, count: int) -> Phonation:
    period = correlation.long_term_period(peak.lag)
    difference = 100 * cycle_difference(peak.height)
    if count == 1:
        return Phonation(
            "periodic",
            f"Periodic: each cycle equals the next to within {difference:.2g} %.",
            peak.height, period, period, 1, correlation,
        )  # fmt: skip
    return Phonation(
        "subharmonic",
        f"Subharmonic: the pattern repeats only every {count} cycles (to within {difference:.2g} %), "
        f"so f_o lies at 1/{count} of the visible rate.",
        peak.height, period, period / count, count, correlation,
    )  # fmt: skip


def _irregular(correlation: Autocorrelation, peaks: list[Peak]) -> Phonation:
    highest = max(peak.height for peak in peaks)
    if highest < MIN_TRACKABLE:
        return Phonation(
            "irregular",
            "Irregular: the glottis vibrates without a recognisable cycle.",
            highest, correlation=correlation,
        )  # fmt: skip
    cycle = next(peak for peak in peaks if peak.height >= ALIKE)
    return Phonation(
        "irregular",
        f"Irregular: each cycle differs from the next by {100 * cycle_difference(cycle.height):.0f} %, "
        f"and no pattern of up to {MAX_CYCLES_PER_PATTERN} cycles repeats.",
        cycle.height, cycle.lag, cycle.lag, 1, correlation,
    )  # fmt: skip
