"""What one core of this machine can do at best, measured by two small compiled loops."""

import numpy as np

from vfcore.kernels.jit import jit

DEGREE = 16
NODES = 1000  # three arrays of them fit in 32 KiB of L1
ROUNDS = 10_000


@jit
def multiply_add(a, x, y, rounds):
    """``rounds`` times sixteen chained multiply-adds on each element of ``a`` (n,): bound by arithmetic alone."""
    for _ in range(rounds):
        for i in range(a.size):
            s = a[i]
            for _ in range(DEGREE):
                s = s * x + y
            a[i] = s


@jit
def triad(a, b, c, factor, rounds):
    """``rounds`` times a = b + factor c on arrays (n,): two loads and a store per multiply-add, bound by L1."""
    for _ in range(rounds):
        for i in range(a.size):
            a[i] = b[i] + factor * c[i]


def peak_task():
    """A task for ``interleaved`` and the floating-point operations it does."""
    a = np.full(NODES, 0.5)
    return lambda: multiply_add(a, 0.5, 0.1, ROUNDS), 2 * DEGREE * NODES * ROUNDS


def cache_task():
    """A task for ``interleaved`` and the bytes it moves."""
    a, b, c = (np.zeros(NODES) for _ in range(3))
    return lambda: triad(a, b, c, 1e-9, 10 * ROUNDS), 24 * NODES * 10 * ROUNDS
