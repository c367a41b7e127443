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
With finite stretch T_j and N' depend on the shape (``tensions``): vfcore/fold/statics.py iterates.

Units: w in m, equations in N/m per column (force per length along x). Order 2 in dx, dy. Source of the equations: the
paper (eqs. MembraneEqn, BeamEqn, ContactModel). Verified in tests/physics/test_static_*; compared with the paper's
static shapes in tests/published/serry_2026.
"""

from vfcore.fold.terms import WALL_NUMBERS
from vfcore.fold.terms.tension import axial, stretched
from vfcore.kernels.jit import jit

NOT_SETTLED, NO_SOLUTION = -1, -2  # returned in place of the number of solves
_STRETCH, _BEAM = WALL_NUMBERS.index("stretch_gain"), WALL_NUMBERS.index("beam_gain")


@jit
def tensions(w, w_b, share, numbers, T):
    """Fill ``T`` (ny,) with the tension of each row over dx², Pa/m, at the present shape; return that of the beam above
    its prestrain over dx², N/m². ``w`` and ``share`` (ny, nx), ``w_b`` (nx,), ``numbers`` (len(WALL_NUMBERS),).
    """
    ny, nx = w.shape
    k = _STRETCH
    for j in range(ny):
        total = 0.0
        for i in range(nx - 1):
            total += share[j, i] * (w[j, i + 1] - w[j, i]) ** 2
        T[j] = stretched(
            numbers[k] * total, numbers[k + 1], numbers[k + 2], numbers[k + 3], numbers[k + 4], numbers[k + 5]
        )
    total, k = 0.0, _BEAM
    for i in range(nx - 1):
        total += (w_b[i + 1] - w_b[i]) ** 2
    return axial(
        numbers[k] * total, numbers[k + 1], numbers[k + 2], numbers[k + 3], numbers[k + 4], numbers[k + 5],
        numbers[k + 6], numbers[k + 7], numbers[k + 8], numbers[k + 9], numbers[k + 10], numbers[k + 11],
    )  # fmt: skip


@jit
def fill_band(band, rhs, T, pull, sheared, dy, K_foun, fields, bands):
    """Fill the matrix and the right side without contact.

    ``band[k, d]`` is entry (k, k + d); shape (n·block, 2·block + 1), block = walls·(ny + 1). ``rhs`` (n, block).
    ``T`` (walls, ny) over dx²; ``pull`` (walls,): N' over dx²; ``sheared``: 1.0, or 0.0 without static shear; ``dy`` and
    ``K_foun`` (walls,); ``fields`` (walls, 9, ny, nx); ``bands`` (walls, 7).
    """
    walls, ny = T.shape
    block = walls * (ny + 1)
    n = band.shape[0] // block
    for k in range(n * block):
        for d in range(2 * block + 1):
            band[k, d] = 0.0
    for s in range(walls):
        scale = dy[0] / dy[s]
        share, shear, K = fields[s, 2], fields[s, 3], fields[s, 5]
        for i in range(n):
            at, beam = i * block + s * ny, i * block + walls * ny + s
            foundation = K_foun[s] * scale
            for j in range(ny):
                edge = j == 0 or j == ny - 1
                m = 0.5 * dy[0] if edge else dy[0]
                stiff = 0.0
                if j > 0:
                    stiff += shear[j - 1, i + 1]
                if j < ny - 1:
                    stiff += shear[j, i + 1]
                    band[at + j, 1] = -dy[0] * sheared * shear[j, i + 1]
                tension = m * T[s, j]
                band[at + j, 0] = tension * (share[j, i] + share[j, i + 1]) + m * K[j, i + 1] + dy[0] * sheared * stiff
                band[at + j, beam - at - j] += -m * K[j, i + 1]
                if i < n - 1:
                    band[at + j, block] = -tension * share[j, i + 1]
                foundation += m * K[j, i + 1]
                rhs[i, s * ny + j] = 0.0
            own = bands[s, 1]
            if i == 0:
                own = bands[s, 0]
            elif i == n - 1:
                own = bands[s, 2]
            band[beam, 0] = foundation - scale * (own - 2.0 * pull[s])
            if i < n - 1:
                band[beam, block] = -scale * (bands[s, 3] + pull[s])
            if i < n - 2:
                band[beam, 2 * block] = -scale * bands[s, 4]
            rhs[i, walls * ny + s] = 0.0
        rhs[0, walls * ny + s] += scale * bands[s, 5]
        rhs[n - 1, walls * ny + s] += scale * bands[s, 6]


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
def equilibrium_with_contact(T, pull, sheared, dy, K_foun, fields, bands, K_col, limit, free, rhs, band, touching, x):
    """Number of solves until the contact set settles; NOT_SETTLED after ``limit`` of them; NO_SOLUTION if one fails.

    Arguments as for ``fill_band``; ``K_col`` (ny, nx) of the pair of walls. Out: ``x`` (n, block). Scratch: ``free``
    and ``band`` (n·block, 2·block + 1), ``rhs`` (n, block), ``touching`` (ny, n) bool.
    """
    walls, ny = T.shape
    n, block = x.shape
    part = 1.0 / walls  # of the half opening, per wall
    fill_band(free, rhs, T, pull, sheared, dy, K_foun, fields, bands)
    for j in range(ny):
        for i in range(n):
            touching[j, i] = False
    flat = x.reshape(n * block)
    for iteration in range(1, limit + 1):
        band[:] = free
        x[:] = rhs
        for i in range(n):
            for j in range(ny):
                if touching[j, i]:
                    m = 0.5 * dy[0] if j == 0 or j == ny - 1 else dy[0]
                    stiff = part * m * K_col[j, i + 1]
                    G = 0.0
                    for s in range(walls):
                        G += fields[s, 0, j, i + 1]
                    for s in range(walls):
                        k = i * block + s * ny + j
                        band[k, 0] += stiff
                        x[i, s * ny + j] += stiff * G
                    if walls == 2:
                        band[i * block + j, ny] += stiff
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
