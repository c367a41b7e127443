"""Cepstral peak prominence: the work on frames before and after the FFTs (vfcore/measures/spectrum.py).

In numpy each line of this would write an array of 0.25 MB; here a frame stays in the cache.
Twin: tests/support/measures_twin.py.
"""

from vfcore.kernels.jit import jit


@jit
def windowed_frames(wave, window, hop, frames):
    """Fill the first len(window) numbers of each row of ``frames`` with a frame of ``wave``, windowed, mean removed.

    Frames begin ``hop`` samples apart.
    """
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
    """Fill ``power`` (count, lines) with |``spectrum``|² relative to the largest of its frame, at least ``least``.

    ``spectrum`` (count, lines or more). Returns False if a frame is silent; ``power`` is then meaningless.
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
    """Height of the cepstral peak above the regression line, mean over frames.

    The peak is the largest value of ``cepstrum`` (count, lines) in [``first``, ``last``). The line is fitted from
    ``fitted_from`` to the end.
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
