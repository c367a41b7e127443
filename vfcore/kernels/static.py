"""Equilibrium of membrane and beam with unilateral contact: Newton on the contact set, one band solve per step.

Setting time derivatives and P_s to zero leaves

    T̃_m ∂_xx w + ∂_y(G̃_m ∂_y w) − K_coup (w − w_b) − K_col (w − G)⁺ = 0
    beam operator · w_b + load − ∫ K_coup (w_b − w) dy − K_foun w_b = 0.

Multiplying each membrane equation by the height of its cell, m_j = dy (half of it at the edges), makes the system
symmetric. With the sign reversed, for column i and row j, and [·] = 1 where w_ij > G_ij, it reads

    m_j (2T + K_j + K_col [·]) w_ij − m_j T (w_i−1,j + w_i+1,j) + dy G (n_j w_ij − Σ w_neighbours) − m_j K_j w_b,i
        = m_j K_col [·] G_ij                                       T = T̃_m/dx², G = G̃_m/dy², n_j neighbours in y
    (Σ m_j K_j + K_foun) w_b,i − (B w_b)_i − Σ_j m_j K_j w_ij = load_i

The system is piecewise linear and monotone, so Newton on the set of touching nodes, starting from the empty set, ends
after finitely many solves. Unknowns are ordered by column, (w_i0 … w_i,ny−1, w_b,i) at each inner x. The beam stencil
spans two columns, so the half bandwidth is 2 (ny + 1). Elimination fills row k = (i, j) only up to the beam of column
i + 1, so the loops stop there. No pivoting: the matrix is positive definite where the equilibrium is stable.

Units: w in m, equations in N/m per column (force per length along x). Order 2 in dx, dy. Source of the equations: the
paper (eqs. MembraneEqn, BeamEqn, ContactModel). Verified in tests/physics/test_static_*; compared with the paper's
static shapes in tests/published/serry_2026.
"""

from vfcore.kernels.jit import jit

NOT_SETTLED, NO_SOLUTION = -1, -2  # returned in place of the number of solves


@jit
def fill_band(band, T, G_t, dy, K, K_foun, beam_matrix):
    """Fill the matrix without contact: ``band[k, d]`` is entry (k, k + d); shape (n (ny + 1), 2 (ny + 1) + 1)."""
    ny, n = K.size, beam_matrix.shape[0]
    block = ny + 1
    for i in range(n):
        beam = i * block + ny
        foundation = K_foun
        for j in range(ny):
            k = i * block + j
            m = 0.5 * dy if j == 0 or j == ny - 1 else dy
            neighbours = 1.0 if j == 0 or j == ny - 1 else 2.0
            for d in range(2 * block + 1):
                band[k, d] = 0.0
            band[k, 0] = m * (2.0 * T + K[j]) + dy * G_t * neighbours
            if j < ny - 1:
                band[k, 1] = -dy * G_t
            band[k, ny - j] += -m * K[j]
            if i < n - 1:
                band[k, block] = -m * T
            foundation += m * K[j]
        for d in range(2 * block + 1):
            band[beam, d] = 0.0
        band[beam, 0] = foundation - beam_matrix[i, i]
        for shift in range(1, 3):
            if i + shift < n:
                band[beam, shift * block] = -beam_matrix[i, i + shift]


@jit
def solve_band(band, x, block):
    """Overwrite ``x`` with the solution, and ``band`` with its factors; False if a pivot is 0 or NaN.

    ``block``: unknowns per column. The row of the beam, the last of a column, spans two columns; other rows end at the
    beam of the next column.
    """
    size = x.size
    for k in range(size):
        pivot = band[k, 0]
        if not abs(pivot) > 0.0:
            return False
        inv_pivot = 1.0 / pivot
        place = k % block
        reach = min(2 * block if place == block - 1 else 2 * block - 1 - place, size - 1 - k)
        for e in range(1, reach + 1):
            factor = band[k, e] * inv_pivot
            x[k + e] -= factor * x[k]
            for d in range(e, reach + 1):
                band[k + e, d - e] -= factor * band[k, d]
    for k in range(size - 1, -1, -1):
        place = k % block
        reach = min(2 * block if place == block - 1 else 2 * block - 1 - place, size - 1 - k)
        total = x[k]
        for e in range(1, reach + 1):
            total -= band[k, e] * x[k + e]
        x[k] = total / band[k, 0]
    return True


@jit
def equilibrium_with_contact(T, G_t, dy, K, K_foun, K_col, beam_matrix, beam_load, G, limit, free, band, touching, x):
    """Number of solves until the contact set settles; NOT_SETTLED after ``limit`` of them; NO_SOLUTION if one fails.

    ``K`` (ny,), ``beam_matrix`` (n, n), ``beam_load`` (n,), ``G`` (ny, n) on the n inner columns. Out: ``x``
    (n, ny + 1), membrane and beam of each column. Scratch: ``free`` and ``band``
    (n (ny + 1), 2 (ny + 1) + 1), ``touching`` (ny, n) bool.
    """
    ny, n = G.shape
    block = ny + 1
    fill_band(free, T, G_t, dy, K, K_foun, beam_matrix)
    for j in range(ny):
        for i in range(n):
            touching[j, i] = False
    flat = x.reshape(n * block)
    for iteration in range(1, limit + 1):
        band[:] = free
        for i in range(n):
            for j in range(ny):
                m = 0.5 * dy if j == 0 or j == ny - 1 else dy
                x[i, j] = 0.0
                if touching[j, i]:
                    band[i * block + j, 0] += m * K_col
                    x[i, j] = m * K_col * G[j, i]
            x[i, ny] = beam_load[i]
        if not solve_band(band, flat, block):
            return NO_SOLUTION
        settled = True
        for j in range(ny):
            for i in range(n):
                now = x[i, j] > G[j, i]
                if now != touching[j, i]:
                    settled = False
                    touching[j, i] = now
        if settled:
            return iteration
    return NOT_SETTLED
