"""What one core of this machine can do at best, measured by two small compiled loops.

They work on the lanes of the step (vfcore/kernels/simd.py): left to the compiler they would take vectors of half that
width on processors that can do more, and the kernel's fraction of what the core can do would look twice as good.
"""

import numpy as np

from vfcore.kernels.jit import jit
from vfcore.kernels.layout import LANES
from vfcore.kernels.simd import load, store

W = LANES["float64"]
CHAINS = 12  # multiply-adds under way at a time: more than any processor's latency needs
REPEATS = 1_000_000
GROUPS = 48  # three arrays of them take 9 KiB of L1
ROUNDS = 100_000


@jit
def multiply_add(a, repeats):
    """``repeats`` multiply-adds on each of the first CHAINS·W numbers of ``a``, with the 2·W that follow them as factor
    and term: bound by arithmetic alone.
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
    """``rounds`` times a = b + factor c on arrays (n,): two loads and a store per multiply-add, bound by L1."""
    for _ in range(rounds):
        for i in range(0, a.size, W):
            store(a, i, load(b, i, W) + factor * load(c, i, W))


def peak_task():
    """A task for ``interleaved`` and the floating-point operations it does."""
    a = np.full((CHAINS + 2) * W, 0.5)
    return lambda: multiply_add(a, REPEATS), 2 * CHAINS * W * REPEATS


def cache_task():
    """A task for ``interleaved`` and the bytes it moves."""
    a, b, c = (np.zeros(GROUPS * W) for _ in range(3))
    return lambda: triad(a, b, c, 1e-9, ROUNDS), 24 * GROUPS * W * ROUNDS
