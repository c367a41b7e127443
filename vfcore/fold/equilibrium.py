"""Equilibrium of membranes and beams with unilateral contact: Newton on the contact set, one band solve per step.

Setting time derivatives and P_s to zero leaves, for each wall,

    T_j ∂_x(τ ∂_x w) + ∂_y(G̃ ∂_y w) − K_coup (w − w_b) − K_col (−h)⁺ = 0,   h: half opening of both walls
    beam operator · w_b + N' ∂_xx w_b + load − ∫ K_coup (w_b − w) dy − K_foun w_b = 0

Multiplying each membrane equation by the height of its cell, m_j = dy (half of it at the edges), makes the system of a
wall symmetric; multiplying the equations of the second wall by dy_left/dy_right makes the contact of the pair symmetric
too. With the sign reversed, for column i and row j of a wall, and [·] = 1 where h_ij < 0, it reads

    m_j (T_j (τ_i + τ_i−1) + K_j) w_ij − m_j T_j (τ_i−1 w_i−1,j + τ_i w_i+1,j) + dy Σ G_j±½ (w_ij − w_i,j±1)
        − m_j K_j w_b,i + m_j K_col [·] (−h_ij) = 0                       T = T̃/dx², G = G̃/dy²
    (Σ m_j K_j + K_foun) w_b,i − (B w_b)_i − Σ_j m_j K_j w_ij = load_i

    −h = w − G for a fold and its mirror image, ½ (w_left − G_left + w_right − G_right) for two walls.

At given tensions the system is piecewise linear and monotone, so Newton on the set of touching nodes, starting from the
empty set, ends after finitely many solves. Unknowns are ordered by column, (w of each wall over y, then w_b of each
wall) at each inner x. The beam stencil spans two columns. Elimination fills a membrane row only up to the last beam of
column i + 1, so the loops stop there. No pivoting: the matrix is positive definite where the equilibrium is stable.
With finite stretch T_j and N' depend on the shape: vfcore/fold/statics.py iterates. Each term adds its share.

Units: w in m, equations in N/m per column (force per length along x). Order 2 in dx, dy. Source of the equations: the
paper (eqs. MembraneEqn, BeamEqn, ContactModel). Verified in tests/physics/test_static_*; compared with the paper's
static shapes in tests/published/serry_2026.
"""

from vfcore.fold.terms import beam, contact, coupling, shear, tension
from vfcore.kernels.jit import jit

NOT_SETTLED, NO_SOLUTION = -1, -2  # returned in place of the number of solves
static_tension, static_shear, static_coupling = tension.static, shear.static, coupling.static
static_beam, static_contact = beam.static, contact.static


@jit
def fill_band(band, rhs, T, pull, sheared, dy, K_foun, fields, bands, cell):
    """Fill the matrix and the right side without contact, term by term.

    ``band[k, d]`` is entry (k, k + d); shape (n·block, 2·block + 1), block = walls·(ny + 1). ``rhs`` (n, block).
    ``T`` (walls, ny) over dx²; ``pull`` (walls,): N' over dx²; ``sheared``: False without static shear; ``dy`` and
    ``K_foun`` (walls,); ``fields`` (walls, 9, ny, nx); ``bands`` (walls, 7). Out: ``cell`` (ny,): heights m_j.
    """
    walls, ny = T.shape
    block = walls * (ny + 1)
    band[:] = 0.0
    rhs[:] = 0.0
    cell[:] = dy[0]
    cell[0] = cell[ny - 1] = 0.5 * dy[0]
    for s in range(walls):
        scale, at, on_beam = dy[0] / dy[s], s * ny, walls * ny + s
        static_tension(band, T[s], fields[s, 2], cell, at, block)
        if sheared:
            static_shear(band, fields[s, 3], dy[0], at, block)
        static_coupling(band, fields[s, 5], K_foun[s] * scale, cell, at, on_beam, block)
        static_beam(band, rhs, bands[s], pull[s], scale, on_beam, block)


@jit
def solve_band(band, x, block, beams):
    """Overwrite ``x`` with the solution, and ``band`` with its factors; False if a pivot is 0 or NaN.

    ``block``: unknowns per column, the last ``beams`` of them beams, whose rows span two columns; other rows end at the
    last beam of the next column.
    """
    size = x.size
    for k in range(size):
        pivot = band[k, 0]
        if not abs(pivot) > 0.0:
            return False
        inv_pivot = 1.0 / pivot
        place = k % block
        reach = min(2 * block if place >= block - beams else 2 * block - 1 - place, size - 1 - k)
        for e in range(1, reach + 1):
            factor = band[k, e] * inv_pivot
            x[k + e] -= factor * x[k]
            for d in range(e, reach + 1):
                band[k + e, d - e] -= factor * band[k, d]
    for k in range(size - 1, -1, -1):
        place = k % block
        reach = min(2 * block if place >= block - beams else 2 * block - 1 - place, size - 1 - k)
        total = x[k]
        for e in range(1, reach + 1):
            total -= band[k, e] * x[k + e]
        x[k] = total / band[k, 0]
    return True


@jit
def equilibrium_with_contact(
    T, pull, sheared, dy, K_foun, fields, bands, K_col, limit, free, rhs, band, cell, touching, x
):  # fmt: skip
    """Number of solves until the contact set settles; NOT_SETTLED after ``limit`` of them; NO_SOLUTION if one fails.

    Arguments as for ``fill_band``; ``K_col`` (ny, nx) of the pair of walls. Out: ``x`` (n, block). Scratch: ``free``
    and ``band`` (n·block, 2·block + 1), ``rhs`` (n, block), ``cell`` (ny,), ``touching`` (ny, n) bool.
    """
    walls, ny = T.shape
    n, block = x.shape
    fill_band(free, rhs, T, pull, sheared, dy, K_foun, fields, bands, cell)
    touching[:] = False
    flat = x.reshape(n * block)
    for iteration in range(1, limit + 1):
        band[:] = free
        x[:] = rhs
        static_contact(band, x, touching, K_col, fields[:, 0], cell, block)
        if not solve_band(band, flat, block, walls):
            return NO_SOLUTION
        settled = True
        for j in range(ny):
            for i in range(n):
                depth = 0.0
                for s in range(walls):
                    depth += x[i, s * ny + j] - fields[s, 0, j, i + 1]
                now = depth > 0.0
                if now != touching[j, i]:
                    settled = False
                    touching[j, i] = now
        if settled:
            return iteration
    return NOT_SETTLED
