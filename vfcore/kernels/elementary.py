"""Elementary functions for floats and SIMD vectors: |x|, and the exponential from products only.

    e^z = (P(z/64))^64,   P the Taylor polynomial of degree 10,   0 ≤ z ≤ 40

so |z/64| ≤ 0.625; the relative error of P is below 2e-10 at the largest z and below 1e-15 for z ≤ 12, the range of a
living tissue (64 times that in e^z). The compiler's own vector form of exp calls the library once per element.
Twin: math.exp.
"""

from vfcore.kernels.jit import jit
from vfcore.kernels.simd import maximum


@jit
def abs_(x):
    """|x|."""
    return maximum(x, 0.0 - x)


@jit
def exponential(z):
    """e^z for 0 ≤ z ≤ 40."""
    x = z * (1.0 / 64.0)
    p = 1.0 / 362880.0 + x * (1.0 / 3628800.0)
    p = 1.0 / 40320.0 + x * p
    p = 1.0 / 5040.0 + x * p
    p = 1.0 / 720.0 + x * p
    p = 1.0 / 120.0 + x * p
    p = 1.0 / 24.0 + x * p
    p = 1.0 / 6.0 + x * p
    p = 0.5 + x * p
    p = 1.0 + x * p
    p = 1.0 + x * p
    p = p * p
    p = p * p
    p = p * p
    p = p * p
    p = p * p
    return p * p
