"""Contact of the fold with the medial plane (paper, eq. ContactModel).

    p_col = (K_col (w − G) + C_col ẇ) H(w − G)

The damper may pull (p_col < 0) while the folds separate; the paper keeps that on purpose.
"""

from vfcore.kernels.jit import jit


@jit
def touching(w, G):
    """Heaviside of the penetration."""
    return 1.0 if w > G else 0.0


@jit
def contact_pressure(w, velocity, G, K_col, C_col):
    """p_col, Pa, positive against the fold."""
    return touching(w, G) * (K_col * (w - G) + C_col * velocity)
