"""Contact of the fold with the medial plane (paper, eq. ContactModel).

    p_col = (K_col (w − G) + C_col ẇ) H(w − G)

The damper may pull (p_col < 0) while the folds separate; the paper keeps that on purpose.
"""

from vfcore.kernels.jit import jit
from vfcore.kernels.simd import where


@jit
def touching(w, G):
    """Heaviside of the penetration."""
    return w > G


@jit
def contact_pressure(w, velocity, G, K_col, C_col):
    """p_col, Pa, positive against the fold."""
    return where(touching(w, G), K_col * (w - G) + C_col * velocity, 0.0)
