"""Per-cycle quantities of a wave: where it reaches a level, and when the glottis opens and closes.

Cycle k is the samples [bounds[k], bounds[k+1]). The definitions are those of vfcore/measures/glottis.py and cycles.py.
In numpy they need a dozen arrays of the length of the wave; here each function reads the wave once.
Twin: tests/support/measures_twin.py.
"""

import math

from vfcore.kernels.jit import inlined, jit
from vfcore.kernels.repetition import vertex

OPEN_FRACTION, OPENS, PEAKS, CLOSES = range(4)


@jit
def first_reached(wave, bounds, levels, places):
    """Fill ``places`` (N,) with the first sample of each cycle at or above its level (N,), else its last sample."""
    for k in range(places.size):
        at = bounds[k]
        while at < bounds[k + 1] - 1 and wave[at] < levels[k]:
            at += 1
        places[k] = at


@jit
def time_above(wave, bounds, levels, shares):
    """Fill ``shares`` (N,) with the fraction of each cycle during which ``wave`` is above ``levels`` (N,)."""
    for k in range(shares.size):
        cycle, level, count = wave[bounds[k] : bounds[k + 1]], levels[k], 0
        for value in cycle:
            count += value > level
        shares[k] = count / cycle.size


@inlined
def refined(wave, at):
    """Sub-sample position of the extremum of ``wave`` at sample ``at``, from the parabola through three samples."""
    at = min(max(at, 1), wave.size - 2)
    offset, _ = vertex(wave[at - 1], wave[at], wave[at + 1])
    return at + offset


@inlined
def lowest_near(wave, place, reach):
    """Sample of the smallest value within ``reach`` samples of sample ``place`` (the first, if several)."""
    lowest = max(place - reach, 0)
    for i in range(lowest, min(place + reach, wave.size - 1) + 1):
        if wave[i] < wave[lowest]:
            lowest = i
    return lowest


@inlined
def minima(wave, places):
    """Fill ``places`` with the samples of the minima of ``wave`` (n,), the middle of flat ones; return their number."""
    found, i = 0, 1
    while i < wave.size - 1:
        end = i
        if wave[i] < wave[i - 1]:
            while end < wave.size - 1 and wave[end + 1] == wave[i]:
                end += 1
            if end < wave.size - 1 and wave[end + 1] > wave[i]:
                places[found] = (i + end) // 2
                found += 1
        i = end + 1
    return found


@jit
def spaced_minima(wave, distance, places):
    """Fill ``places`` (n // 2,) with minima of ``wave`` (n,) at least ``distance`` samples apart; return their number.

    The lowest is kept and all nearer than ``distance`` are dropped, then the lowest of the rest, and so on. They are
    returned in that order.
    """
    left = minima(wave, places)
    kept = 0
    while kept < left:  # places[:kept] are kept, places[kept:left] are candidates
        best = kept
        for k in range(kept, left):
            if wave[places[k]] < wave[places[best]]:
                best = k
        lowest = places[best]
        places[best], places[kept] = places[kept], lowest
        kept += 1
        stay = kept
        for k in range(kept, left):
            if abs(places[k] - lowest) >= distance:
                places[stay] = places[k]
                stay += 1
        left = stay
    return kept


@jit
def lowest_each(wave, places, reach, found):
    """``lowest_near`` of each of ``places`` (n,) into ``found`` (n,)."""
    for k in range(places.size):
        found[k] = lowest_near(wave, places[k], reach)


@jit
def refined_each(wave, places, found):
    """``refined`` of each of ``places`` (n,) into ``found`` (n,)."""
    for k in range(places.size):
        found[k] = refined(wave, places[k])


@inlined
def crossing(area, at, outward, level, flank, first, last):
    """Distance (0 to 1 sample) from the open sample ``at`` back to where the area crosses ``level``.

    ``outward``, 1 or −1, is the direction into the open phase; only samples from ``first`` to ``last`` are used. If the
    closed neighbour lies on the flank, that is, if the area falls beyond it by more than ``flank`` of the step across
    the level, interpolation is linear. Otherwise it is the parabola value + slope s + curve s² through three open
    samples, s counted towards the closed side.
    """
    closed = area[at - outward]
    beyond = area[min(max(at - 2 * outward, first), last)]
    value, inside = area[at], area[min(max(at + outward, first), last)]
    deeper = area[min(max(at + 2 * outward, first), last)]
    height = value - level
    curve = 0.5 * (value - 2.0 * inside + deeper)
    slope = value - inside + curve
    if closed - beyond > flank * (value - closed) or slope >= 0.0:
        per_sample = value - closed
    else:
        per_sample = 0.5 * (math.sqrt(max(slope * slope - 4.0 * curve * height, 0.0)) - slope)
    # A plateau at the level has no slope: the crossing is the sample itself.
    return min(max(height / per_sample, 0.0), 1.0) if per_sample > 0.0 else 0.0


@jit
def open_phases(area, bounds, largest_at, closed_fraction, flank, phases):
    """Fill ``phases`` (4, N): open fraction of the cycle; times of opening, peak and closing, in samples of ``area``.

    ``area`` (n,), any unit; ``bounds`` (N + 1,); ``largest_at`` (N,), sample of the largest area of each cycle. Open
    means above ``closed_fraction`` of that largest area. A cycle that never crosses this level opens and closes at the
    minima of the area near its bounds.
    """
    count = largest_at.size
    first, last = bounds[0], bounds[count] - 1
    shortest = last
    for k in range(count):
        shortest = min(shortest, bounds[k + 1] - bounds[k])
    reach = shortest // 16
    low = refined(area, lowest_near(area, first, reach))
    for k in range(count):
        begin, end = bounds[k], bounds[k + 1]
        level = closed_fraction * area[largest_at[k]]
        level_next = closed_fraction * area[largest_at[k + 1]] if k + 1 < count else level
        next_low = refined(area, lowest_near(area, end, reach))
        opens, closes, crossed_up = low, next_low, False
        is_open = area[begin] > level
        opened = -float(begin) if is_open else 0.0  # Σ closing − Σ opening instants
        for i in range(begin, min(end, last)):
            above = level_next if i + 1 == end else level
            after = area[i + 1] > above
            if after and not is_open:
                instant = i + 1 - crossing(area, i + 1, 1, above, flank, first, last)
                opened -= instant
                if not crossed_up:
                    opens, crossed_up = instant, True
            elif is_open and not after:
                closes = i + crossing(area, i, -1, level, flank, first, last)
                opened += closes
            is_open = after
        if is_open:
            opened += end
        phases[OPEN_FRACTION, k] = min(max(opened / (end - begin), 0.0), 1.0)
        phases[OPENS, k], phases[CLOSES, k] = opens, closes
        phases[PEAKS, k] = refined(area, largest_at[k])
        low = next_low
