"""Resampling by a ratio up/down with the taps h of a low pass at up times the rate, in its polyphase form.

y_m = Σ_k h[m·down − k·up] x_k  =  Σ_i h[p + i·up] x_{q−i},   m·down = q·up + p,  0 ≤ p < up
"""

from vfcore.kernels.jit import jit


@jit
def resample(samples, branches, down, out):
    """Fill ``out`` (n·up/down,) for the last n of ``samples`` (reach − 1 + n,), the ones before them being memory.

    ``branches`` (up, reach): row p holds h[p + i·up], largest i first. Any unit; ``out`` has that of ``samples``.
    """
    up, reach = branches.shape
    for m in range(out.size):
        newest, branch = m * down // up, m * down % up
        total = 0.0
        for i in range(reach):
            total += branches[branch, i] * samples[newest + i]
        out[m] = total
