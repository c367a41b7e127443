"""Contact of the folds (paper, eq. ContactModel), written on the opening between two walls.

With h the half opening, [(G − w)_left + (G − w)_right]/2, and s the closing speed, (ẇ_left + ẇ_right)/2,

    p_col = (K_col (−h) + C_col s) H(−h),      H(0) = 0

on both walls alike. For a fold and its mirror image h = G − w and s = ẇ: the paper's law against the medial plane.
Walls of unlike stiffness are springs in series: K_col is 2 K_l K_r/(K_l + K_r), and C_col likewise.

Node by node: no stencil. Pressures in Pa, h in m, K_col in Pa/m, C_col in Pa·s/m; floats or SIMD vectors. The damper
may pull (p_col < 0) while the folds separate; the paper keeps that on purpose. First order in the position of the
contact edge; K_col and C_col enter the stability bound as if engaged everywhere. Static: the same law without speed.
Stored energy per area of each wall ½ K_col h². Verified in tests/physics/test_contact_law.py; not validated against
measured contact pressures.
"""

import numpy as np

from vfcore.kernels.jit import jit
from vfcore.kernels.simd import select

#: Of the glottis.
NUMBERS = ("K_col", "C_col")


@jit
def touching(depth):
    """Heaviside of the penetration, ``depth`` = −h."""
    return depth > 0.0


@jit
def contact_pressure(depth, speed, K_col, C_col):
    """p_col, Pa, positive against the folds. ``depth``: −h, m; ``speed``: of closing, m/s."""
    return select(touching(depth), K_col * depth + C_col * speed, 0.0)


def in_series(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Stiffness or damper of the contact of two walls, node by node; of equal ones exactly that of each."""
    total = one + other
    return np.where(one == other, one, 2.0 * one * other / np.where(total > 0.0, total, 1.0))


@jit
def static(band, x, touching_nodes, K_col, planes, cell, block):
    """Add the contact of the walls to the static matrix and right side ``x`` (n, block), as
    vfcore/fold/equilibrium.py stores them. ``touching_nodes`` (ny, n); ``K_col`` (ny, nx) of the pair; ``planes``
    (walls, ny, nx): the medial planes; ``cell`` (ny,): heights m_j.
    """
    walls, ny = planes.shape[:2]
    part = 1.0 / walls  # of the half opening, per wall
    for i in range(x.shape[0]):
        for j in range(ny):
            if touching_nodes[j, i]:
                spring, G = part * cell[j] * K_col[j, i + 1], 0.0
                for s in range(walls):
                    G += planes[s, j, i + 1]
                for s in range(walls):
                    k = s * ny + j
                    band[i * block + k, 0] += spring
                    x[i, k] += spring * G
                if walls == 2:
                    band[i * block + j, ny] += spring


def energy(half: np.ndarray, K_col: np.ndarray, cell: np.ndarray, dx: float) -> float:
    """Stored in one wall, J, at the half opening ``half`` (ny, nx); ``K_col`` (ny, nx) of the pair."""
    depth = np.maximum(-half, 0.0)[:, 1:-1]
    return 0.5 * dx * float((cell[:, None] * K_col[:, 1:-1] * depth**2).sum())
