"""The phonation state, decided before anything else is measured.

The criterion uses one wave over the measured part, the glottal area, else the flow, else the sound (vibration.py,
with the bounds of each), in this order:

1. amplitude  — the wave must vary enough to be audible, else ``none``;
2. steadiness — the vibration must neither die out nor still be building up, else ``none``: ringing after onset is
   not phonation, and a wave that still grows has not settled;
3. repetition — the wave must equal itself one lag later to within the bound for a nearly periodic voice.
   If the repeating pattern holds several similar cycles it is ``subharmonic``, else ``periodic``;
   if no lag repeats, ``irregular``.

The glottis need not close: one that never does can vibrate perfectly periodically.

Words of all measures: a *cycle* is one opening and closing of the glottis; a *pattern* is what repeats, one cycle or,
in a subharmonic voice, several unequal ones, and f_o is its reciprocal; a *period* is the length of either in samples;
a *swing* is a peak-to-peak amplitude, largest minus smallest value.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import sqrt

import numpy as np

from vfcore.measures.pitch import HIGHEST_RATE_HZ, LOWEST_RATE_HZ, Autocorrelation, Peak, autocorrelation
from vfcore.measures.vibration import ALIKE, AREA_BOUNDS, Bounds, Vibration

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
# The next cycle alike begins at a whole fraction of the pattern, give or take this share of a cycle.
FRACTION_TOLERANCE = 0.1
# Longer patterns cannot be distinguished from irregular voices in half a second.
MAX_CYCLES_PER_PATTERN = 6
# A pattern of several cycles must also repeat this many patterns later: two incommensurate rates may match once.
LATER_PATTERNS = (2, 4)
# Below this autocorrelation no cycle can be followed to the next (Boersma 1993 takes 0.45 as his voicing threshold).
MIN_TRACKABLE = 0.45
# Sustained phonation cannot be judged on less: each quarter must hold at least one cycle of the lowest voices (40 Hz).
MIN_WINDOW_S = 0.1

STATES = ("none", "periodic", "subharmonic", "irregular")


@dataclass(frozen=True, slots=True, eq=False)
class Repetition:
    """What was found to repeat, lengths in samples.

    ``pattern``: the reciprocal of f_o. ``cycle``: shorter than the pattern by the whole factor ``cycles_per_pattern``
    in a subharmonic voice, else the same. ``correlation``: the autocorrelation in which they were found.
    """

    pattern: float
    cycle: float
    cycles_per_pattern: int
    correlation: Autocorrelation


@dataclass(frozen=True, slots=True, eq=False)
class Phonation:
    """State and the sentence that explains it.

    ``periodicity``: normalised autocorrelation peak at the repeating pattern (for irregular voices: at the cycle); None
    without phonation. ``repetition``: None where no cycle can be recognised.
    """

    state: str
    explanation: str
    periodicity: float | None = None
    repetition: Repetition | None = None


def judge_phonation(vibration: Vibration, correlate: Callable[[], Autocorrelation] | None = None) -> Phonation:
    """The phonation state of a wave.

    ``correlate``: called for the autocorrelation of ``vibration.source``; None where it is to be computed here.
    """
    found = _judged(vibration, correlate)
    if vibration.bounds is AREA_BOUNDS:
        return found
    return replace(found, explanation=f"{found.explanation} Judged on the {vibration.bounds.name}.")


def _judged(vibration: Vibration, correlate: Callable[[], Autocorrelation] | None) -> Phonation:
    wave, rate, bounds = np.asarray(vibration.wave, dtype=np.float64), vibration.sample_rate_hz, vibration.bounds
    silence = _too_small(wave, rate, bounds) or _unsteady(wave, int(STRETCH_S * rate), bounds)
    if silence:
        return Phonation("none", silence)
    correlation = autocorrelation(vibration.source) if correlate is None else correlate()
    lag_min = max(int(rate / HIGHEST_RATE_HZ), 2)
    lag_max = min(int(rate / LOWEST_RATE_HZ), len(wave) // 3)
    peaks = correlation.peaks(lag_min, lag_max)
    if not peaks:
        return Phonation("none", f"No phonation: the {bounds.name} changes but does not vibrate.")
    for peak in peaks:
        if cycle_difference(peak.height) <= bounds.max_difference:
            peak = correlation.near(peak.lag, 0.02 * peak.lag + 1.0)
            count = _cycles_in_pattern(peak, peaks, bounds.alike)
            if count == 1 or (
                count <= MAX_CYCLES_PER_PATTERN and _repeats_later(correlation, peak, bounds.max_difference)
            ):
                return _repeating(correlation, peak, count)
    return _irregular(correlation, peaks, bounds.followed)


def cycle_difference(height: float) -> float:
    """Rms difference between the wave and its shifted copy over the rms of the wave, from the autocorrelation."""
    return sqrt(2.0 * max(1.0 - height, 0.0))


def _too_small(wave: np.ndarray, sample_rate_hz: float, bounds: Bounds) -> str | None:
    duration = len(wave) / sample_rate_hz
    if duration < MIN_WINDOW_S:
        return (
            f"Not judged: the measured part lasts {duration * 1e3:.0f} ms, "
            f"and at least {MIN_WINDOW_S * 1e3:.0f} ms are needed to call phonation sustained."
        )
    last_half = wave[len(wave) // 2 :]
    swing = float(np.ptp(last_half))
    mean = float(last_half.mean())
    if last_half.max() == 0.0:
        return f"No phonation: {bounds.none_at_all}."
    if swing < bounds.min_swing:
        return (
            f"No phonation: the {bounds.name} varies by {swing * bounds.unit_per_si:.2g} {bounds.unit}, "
            f"less than the {bounds.min_swing * bounds.unit_per_si:.3g} {bounds.unit} that would be audible."
        )
    if swing < bounds.min_relative_swing * mean:
        return (
            f"No phonation: the {bounds.name} varies by {100 * swing / mean:.2g} % of its mean, "
            f"less than {100 * bounds.min_relative_swing:g} %; the flow is practically steady."
        )
    return None


def _unsteady(wave: np.ndarray, stretch: int, bounds: Bounds) -> str | None:
    swings = _swings(wave, len(wave) // 4)
    before, after = swings[:-1], swings[1:]
    if np.all(after < STEADY_RATIO * before):
        return _dies_out(swings, bounds)
    if np.all(before < STEADY_RATIO * after):
        return _builds_up(swings, bounds)
    return _uneven(swings, MIN_QUARTER_RATIO, bounds) or _uneven(_swings(wave, stretch), MIN_STRETCH_RATIO, bounds)


def _uneven(swings: np.ndarray, smallest_ratio: float, bounds: Bounds) -> str | None:
    smallest, largest = int(swings.argmin()), int(swings.argmax())
    if swings[smallest] >= smallest_ratio * swings[largest]:
        return None
    return _dies_out(swings, bounds) if smallest > largest else _builds_up(swings, bounds)


def _swings(wave: np.ndarray, length: int) -> np.ndarray:
    """Swings in consecutive stretches of ``length`` samples, up to the end of the window."""
    count = len(wave) // length
    return np.ptp(wave[len(wave) - count * length :].reshape(count, length), axis=1)


def _dies_out(swings: np.ndarray, bounds: Bounds) -> str:
    return f"No sustained phonation: the vibration dies out, {_change(swings, bounds)}."


def _builds_up(swings: np.ndarray, bounds: Bounds) -> str:
    return (
        f"Phonation not settled: the vibration is still building up, {_change(swings, bounds)}; "
        "a longer run would show whether it is sustained."
    )


def _change(swings: np.ndarray, bounds: Bounds) -> str:
    first, last = swings[0] * bounds.unit_per_si, swings[-1] * bounds.unit_per_si
    return f"the {bounds.name} swinging by {first:.3g} {bounds.unit} at first and by {last:.3g} {bounds.unit} at last"


def _cycles_in_pattern(pattern: Peak, peaks: list[Peak], alike: float) -> int:
    """How many visible cycles make the pattern."""
    for peak in peaks:
        ratio = pattern.lag / peak.lag
        count = round(ratio)
        if count < 2:
            break
        if peak.height >= alike and abs(ratio - count) <= FRACTION_TOLERANCE * count:
            return count
    return 1


def _repeats_later(correlation: Autocorrelation, pattern: Peak, max_difference: float) -> bool:
    later = [k * pattern.lag for k in LATER_PATTERNS if k * pattern.lag < len(correlation.values) - 2]
    return all(cycle_difference(correlation.near(lag, 0.05 * pattern.lag).height) <= max_difference for lag in later)


def _repeating(correlation: Autocorrelation, peak: Peak, count: int) -> Phonation:
    period = correlation.long_term_period(peak.lag)
    difference = 100 * cycle_difference(peak.height)
    if count == 1:
        return Phonation(
            "periodic",
            f"Periodic: each cycle equals the next to within {difference:.2g} %.",
            peak.height, Repetition(period, period, 1, correlation),
        )  # fmt: skip
    return Phonation(
        "subharmonic",
        f"Subharmonic: the pattern repeats only every {count} cycles (to within {difference:.2g} %), "
        f"so f_o lies at 1/{count} of the visible rate.",
        peak.height, Repetition(period, period / count, count, correlation),
    )  # fmt: skip


def _irregular(correlation: Autocorrelation, peaks: list[Peak], followed: float) -> Phonation:
    highest = max(peak.height for peak in peaks)
    if highest < MIN_TRACKABLE:
        return Phonation("irregular", "Irregular: the glottis vibrates without a recognisable cycle.", highest)
    cycle = next(peak for peak in peaks if peak.height >= max(ALIKE, followed * highest))
    return Phonation(
        "irregular",
        f"Irregular: each cycle differs from the next by {100 * cycle_difference(cycle.height):.0f} %, "
        f"and no pattern of up to {MAX_CYCLES_PER_PATTERN} cycles repeats.",
        cycle.height, Repetition(cycle.lag, cycle.lag, 1, correlation),
    )  # fmt: skip
