"""Frames of a sound before and after the transforms of the cepstral peak prominence (vfcore/measures/spectrum.py).

Vectorised over whole arrays each line of this would write a quarter of a megabyte; here a frame stays in the cache.
Twin: tests/support/measures_twin.py.
"""

from vfcore.kernels.jit import jit


@jit
def windowed_frames(wave, window, hop, frames):
    """Fill the first len(window) of each of ``frames`` with stretches of ``wave`` ``hop`` apart, about their means,
    windowed."""
    count, length = len(frames), len(window)
    for f in range(count):
        stretch, mean = wave[f * hop : f * hop + length], 0.0
        for k in range(length):
            mean += stretch[k]
        mean /= length
        for k in range(length):
            frames[f, k] = (stretch[k] - mean) * window[k]


@jit
def relative_power(spectrum, least, power):
    """Fill ``power`` (count, lines) with |``spectrum``|² over the largest of each frame, but at least ``least``.

    ``spectrum`` (count, lines or more). False, and ``power`` means nothing, where a frame is silent.
    """
    count, lines = power.shape
    for f in range(count):
        strongest = 0.0
        for k in range(lines):
            line = spectrum[f, k]
            power[f, k] = line.real * line.real + line.imag * line.imag
            strongest = max(strongest, power[f, k])
        if strongest == 0.0:
            return False
        for k in range(lines):
            power[f, k] = max(power[f, k] / strongest, least)
    return True


@jit
def mean_prominence(cepstrum, fitted_from, first, last):
    """Height of the largest of ``cepstrum`` (count, lines) from ``first`` to before ``last`` above the straight line
    through those from ``fitted_from`` on, mean over frames.
    """
    count, lines = cepstrum.shape
    middle, square, total = 0.5 * (fitted_from + lines - 1), 0.0, 0.0
    for q in range(fitted_from, lines):
        square += (q - middle) * (q - middle)
    for f in range(count):
        level = slope = 0.0
        for q in range(fitted_from, lines):
            level += cepstrum[f, q]
            slope += cepstrum[f, q] * (q - middle)
        level, slope, peak = level / (lines - fitted_from), slope / square, first
        for q in range(first, last):
            if cepstrum[f, q] > cepstrum[f, peak]:
                peak = q
        total += cepstrum[f, peak] - (level + slope * (peak - middle))
    return total / count
