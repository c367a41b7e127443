"""Twins of a fold whose material varies over the surface: one smooth patch, as of a lesion."""

import numpy as np

from tests.support.wall_twin import WallTwin


def patch_shape(wall: WallTwin, x: float = 0.4, y: float = 0.6):
    """A bump of height 1 at the fractions (x, y), on the nodes (nx, ny)."""
    along = np.linspace(0, 1, wall.nx)[:, None] - x
    across = np.linspace(0, 1, wall.ny)[None, :] - y
    return np.exp(-((along / 0.15) ** 2) - (across / 0.3) ** 2)


def patched(wall: WallTwin, strength: float = 1.0, bump_m: float = 0.0) -> WallTwin:
    """The same fold with a patch that stands out by ``bump_m`` and in which every other field changes too."""
    patch = patch_shape(wall)
    along_x, along_y = (patch[1:] + patch[:-1]) / 2, (patch[:, 1:] + patch[:, :-1]) / 2
    f = wall.fields
    return wall.with_fields(
        rho_s=f.rho_s * (1 + 0.8 * strength * patch),
        tau=f.tau * (1 + 1.5 * strength * along_x),
        G_m=f.G_m * (1 + 0.6 * strength * along_y),
        eta_m=f.eta_m * (1 + 0.4 * strength * along_y),
        K_coup=f.K_coup * (1 - 0.7 * strength * patch),
        C_coup=f.C_coup * (1 + 2.0 * strength * patch),
        K_col=f.K_col * (1 + 1.2 * strength * patch),
        C_col=f.C_col * (1 - 0.5 * strength * patch),
        medial=f.medial - bump_m * patch,
    )
