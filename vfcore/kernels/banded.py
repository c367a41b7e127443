"""Factors and inverse of a symmetric pentadiagonal matrix, the implicit one of the beam: M = I − dt²A/4.

M = L D Lᵀ, with two subdiagonals in L. The diagonal of M varies; its first and second off-diagonals are the constants
``first`` and ``second`` (the end moments change only the two corners of the diagonal, vfcore/fold/terms/beam.py):

    D_i = m_ii − a_i² D_{i−1} − c_i² D_{i−2},   c_i = second/D_{i−2},   a_i = (first − c_i D_{i−2} a_{i−1})/D_{i−1}

M x = r is then solved by y_i = r_i − a_i y_{i−1} − c_i y_{i−2} and x_i = y_i/D_i − a_{i+1} x_{i+1} − c_{i+2} x_{i+2}.
No pivoting: M must be positive definite, which holds where A has no positive eigenvalue. Dimensionless; direct, so
exact but for rounding. Twin: np.linalg.inv (tests/physics/test_kernel_assembly.py).
"""

from vfcore.kernels.jit import inlined


@inlined
def factor(diagonal, first, second, a, c):
    """Overwrite ``diagonal`` (n,) of M with D, and fill ``a`` and ``c`` (n,); a_0, c_0 and c_1 are 0."""
    for i in range(diagonal.size):
        a[i] = c[i] = 0.0
        if i > 1:
            c[i] = second / diagonal[i - 2]
        if i > 0:
            a[i] = (first - c[i] * diagonal[i - 2] * a[i - 1] if i > 1 else first) / diagonal[i - 1]
            diagonal[i] -= a[i] * a[i] * diagonal[i - 1]
        if i > 1:
            diagonal[i] -= c[i] * c[i] * diagonal[i - 2]


@inlined
def invert(D, a, c, inverse, stride):
    """Fill the first n columns of ``inverse``, n rows of ``stride`` numbers, from the factors (n,).

    The substitutions run on all n unit vectors at once, row by row.
    """
    n = D.size
    for i in range(n):
        row = i * stride
        for k in range(n):
            inverse[row + k] = 1.0 if k == i else 0.0
        if i > 0:
            for k in range(n):
                inverse[row + k] -= a[i] * inverse[row - stride + k]
        if i > 1:
            for k in range(n):
                inverse[row + k] -= c[i] * inverse[row - 2 * stride + k]
    for i in range(n):
        inv_D = 1.0 / D[i]
        for k in range(n):
            inverse[i * stride + k] *= inv_D
    for j in range(n):
        i = n - 1 - j
        row = i * stride
        if i + 1 < n:
            for k in range(n):
                inverse[row + k] -= a[i + 1] * inverse[row + stride + k]
        if i + 2 < n:
            for k in range(n):
                inverse[row + k] -= c[i + 2] * inverse[row + 2 * stride + k]
