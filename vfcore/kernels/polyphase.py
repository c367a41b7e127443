"""Resampling by a ratio up/down in polyphase form; h are the taps of a low-pass filter at ``up`` times the rate.

y_m = Σ_k h[m·down − k·up] x_k  =  Σ_i h[p + i·up] x_{q−i},   m·down = q·up + p,  0 ≤ p < up
"""

from vfcore.kernels.jit import inlined, jit
from vfcore.kernels.response import respond


@inlined
def resample(block, samples, branches, down, out):
    """Fill ``out`` (n·up/down,) for the next ``block`` (n,).

    ``samples`` (reach − 1 + n,): the samples up to the end of the previous block; shifted by one block here.
    ``branches`` (up, reach): row p holds h[p + i·up], largest i first. Any unit; ``out`` has that of ``block``.
    """
    n = block.size
    up, reach = branches.shape
    for k in range(reach - 1):
        samples[k] = samples[k + n]
    for i in range(n):
        samples[reach - 1 + i] = block[i]
    for m in range(out.size):
        newest, branch = m * down // up, m * down % up
        total = 0.0
        for i in range(reach):
            total += branches[branch, i] * samples[newest + i]
        out[m] = total


@jit
def filter_and_resample(flow, memory, backward, samples, branches, down, lip, audio):
    """``respond``, then ``resample``: ``lip`` (n,) and ``audio`` (n·up/down,) for one block of ``flow``."""
    respond(flow, memory, backward, lip)
    resample(lip, samples, branches, down, audio)
