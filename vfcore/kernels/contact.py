"""Contact of the fold with the medial plane (paper, eq. ContactModel).

    p_col = (K_col (w − G) + C_col ẇ) H(w − G),      H(0) = 0

Node by node: no stencil. Pressures in Pa, w and G in m, K_col in Pa/m, C_col in Pa·s/m; floats or SIMD vectors. The
damper may pull (p_col < 0) while the folds separate; the paper keeps that on purpose. First order in the position of
the contact edge; K_col and C_col enter the stability bound as if engaged everywhere (vfcore/fold/stability.py).
Verified in tests/physics/test_contact_law.py; not validated against measured contact pressures.
"""

from vfcore.kernels.jit import jit
from vfcore.kernels.simd import select


@jit
def touching(w, G):
    """Heaviside of the penetration."""
    return w > G


@jit
def contact_pressure(w, velocity, G, K_col, C_col):
    """p_col, Pa, positive against the fold."""
    return select(touching(w, G), K_col * (w - G) + C_col * velocity, 0.0)
