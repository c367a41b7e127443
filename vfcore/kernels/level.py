"""Root mean square of a wave about its mean, in two passes and without a copy."""

import math

from vfcore.kernels.jit import jit


@jit
def rms_about_mean(wave):
    """√(mean (x − mean x)²) of ``wave`` (n,), any unit."""
    n, mean, square = wave.size, 0.0, 0.0
    for i in range(n):
        mean += wave[i]
    mean /= n
    for i in range(n):
        square += (wave[i] - mean) * (wave[i] - mean)
    return math.sqrt(square / n)
