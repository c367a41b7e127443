"""Magnitudes of the first two harmonics of a wave, each at its exact frequency.

    |Σ_k x_k e^{i k φ}|,  φ = 2π f_o/f_s and twice that,  k = a B + b:  Σ_a e^{i a B φ} Σ_b x_{aB+b} e^{i b φ}

With B near √n, n samples need about 2√n sines, and the inner sums do not depend on each other.
"""

import math

from vfcore.kernels.jit import jit


@jit
def first_two(wave, window, turn, table):
    """Magnitudes of the lines at ``turn`` and 2·``turn`` (rad per sample) of ``wave`` (n,) about its mean, windowed.

    ``window`` (n,); ``table`` (4, B) is scratch, B near √n. Any unit.
    """
    n, across, mean = wave.size, table.shape[1], 0.0
    for k in range(n):
        mean += wave[k]
    mean /= n
    for b in range(across):
        table[0, b], table[1, b] = math.cos(turn * b), math.sin(turn * b)
        table[2, b], table[3, b] = math.cos(2.0 * turn * b), math.sin(2.0 * turn * b)
    re_1 = im_1 = re_2 = im_2 = 0.0
    for begin in range(0, n, across):
        cos_1 = sin_1 = cos_2 = sin_2 = 0.0
        for b in range(min(across, n - begin)):
            x = (wave[begin + b] - mean) * window[begin + b]
            cos_1 += x * table[0, b]
            sin_1 += x * table[1, b]
            cos_2 += x * table[2, b]
            sin_2 += x * table[3, b]
        c, s = math.cos(turn * begin), math.sin(turn * begin)
        re_1 += c * cos_1 - s * sin_1
        im_1 += s * cos_1 + c * sin_1
        c, s = math.cos(2.0 * turn * begin), math.sin(2.0 * turn * begin)
        re_2 += c * cos_2 - s * sin_2
        im_2 += s * cos_2 + c * sin_2
    return math.hypot(re_1, im_1), math.hypot(re_2, im_2)
