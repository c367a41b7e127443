"""Peak arithmetic and L1 bandwidth of one core, measured by two small compiled loops.

They use the SIMD vectors of the step (vfcore/kernels/simd.py). The compiler alone would choose vectors of half that
width on some processors, and the fraction of the peak that the kernel reaches would look twice as high.
"""

import numpy as np

from vfcore.fold.form import LANES
from vfcore.kernels.jit import jit
from vfcore.kernels.simd import load, store

W = LANES["float64"]
CHAINS = 12  # independent multiply-adds, enough to hide the latency on any processor
REPEATS = 1_000_000
GROUPS = 48  # vectors per array; three arrays take 9 KiB of L1
ROUNDS = 100_000


@jit
def multiply_add(a, repeats):
    """``repeats`` multiply-adds on each of the first CHAINS·W numbers of ``a``; limited by arithmetic alone.

    The following 2·W numbers of ``a`` are the factor and the term.
    """
    x, y = load(a, CHAINS * W, W), load(a, CHAINS * W + W, W)
    a_0, a_1, a_2, a_3 = load(a, 0, W), load(a, W, W), load(a, 2 * W, W), load(a, 3 * W, W)
    a_4, a_5, a_6, a_7 = load(a, 4 * W, W), load(a, 5 * W, W), load(a, 6 * W, W), load(a, 7 * W, W)
    a_8, a_9, a_10, a_11 = load(a, 8 * W, W), load(a, 9 * W, W), load(a, 10 * W, W), load(a, 11 * W, W)
    for _ in range(repeats):
        a_0, a_1, a_2, a_3 = a_0 * x + y, a_1 * x + y, a_2 * x + y, a_3 * x + y
        a_4, a_5, a_6, a_7 = a_4 * x + y, a_5 * x + y, a_6 * x + y, a_7 * x + y
        a_8, a_9, a_10, a_11 = a_8 * x + y, a_9 * x + y, a_10 * x + y, a_11 * x + y
    store(a, 0, a_0 + a_1 + a_2 + a_3 + a_4 + a_5 + a_6 + a_7 + a_8 + a_9 + a_10 + a_11)


@jit
def triad(a, b, c, factor, rounds):
    """``rounds`` times a = b + factor c on arrays (n,): two loads and a store per multiply-add, limited by L1."""
    for _ in range(rounds):
        for i in range(0, a.size, W):
            store(a, i, load(b, i, W) + factor * load(c, i, W))


def peak_task():
    """A task for ``interleaved``, and its number of floating-point operations."""
    a = np.full((CHAINS + 2) * W, 0.5)
    return lambda: multiply_add(a, REPEATS), 2 * CHAINS * W * REPEATS


def cache_task():
    """A task for ``interleaved``, and the number of bytes it moves."""
    a, b, c = (np.zeros(GROUPS * W) for _ in range(3))
    return lambda: triad(a, b, c, 1e-9, ROUNDS), 24 * GROUPS * W * ROUNDS
