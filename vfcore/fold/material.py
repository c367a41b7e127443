"""Material and medial plane of a wall as fields over its surface, uniform unless a patch changes them.

Fields on the nodes (i, j): medial plane G = x tan θ_g + y tan θ_conv (m); mass per area ρ_s; coupling K_coup(y) and
C_coup; contact K_col and C_col. On the intervals along x, i to i+1: the share τ of the tension (1). On the half rows,
j to j+1: shear G̃ and η̃ over dy².

A patch is centred at (x_0, y_0), fractions of length and thickness, and smooth:

    s(x, y) = cos²(π r/2) for r < 1, else 0,    r² = ((x − x_0 L)/(l/2))² + ((y − y_0 b)/(w/2))²

with the extents l along the fold and w over the thickness. It moves the medial surface by its height between the fixed
ends, G → G − height·s, and multiplies: mass by 1 + (m − 1) s; tension, shear, coupling and contact by 1 + (k − 1) s;
the dampers of shear, coupling and contact by 1 + (c − 1) s. Several patches multiply. The shape is this project's
choice; what it stands for is in vfcore/spec. Algebraic; a patch is resolved by the grid if it spans several nodes.
"""

import math

from vfcore.fold.terms.coupling import coupling_stiffness
from vfcore.kernels.jit import jit

#: The fields of a wall, in the order in which ``fill_fields`` stacks them.
FIELDS = (
    "G", "mass", "tension_share", "shear", "shear_viscosity", "coupling", "coupling_damper", "contact",
    "contact_damper",
)  # fmt: skip
#: Numbers of a patch: centre as fractions, extents and height in m, ratios of mass, stiffness and viscosity.
PATCH = ("x", "y", "length_m", "width_m", "height_m", "mass_ratio", "stiffness_ratio", "viscosity_ratio")


@jit
def weight(x, y, length, thickness, patch):
    """s of a patch at (x, y), m; ``length`` and ``thickness`` of the fold, m."""
    along, across = (x - patch[0] * length) / (0.5 * patch[2]), (y - patch[1] * thickness) / (0.5 * patch[3])
    r2 = along * along + across * across
    return math.cos(0.5 * math.pi * math.sqrt(r2)) ** 2 if r2 < 1.0 else 0.0


@jit
def fill_fields(length, thickness, rho_s, G_t, eta_t, opening, leaning, inferior_stiff, c, patches, fields):
    """Fill ``fields`` (9, ny, nx), FIELDS. ``G_t`` and ``eta_t``: G̃ and η̃, N/m and N·s/m; ``opening``: tan θ_g;
    ``leaning``: tan θ_conv; ``c``: a vfcore.larynx.tissue.prestrain.Constants; ``patches`` (n, 8), PATCH.
    """
    ny, nx = fields.shape[1:]
    dx, dy = length / (nx - 1), thickness / (ny - 1)
    for j in range(ny):
        from_stiff_edge = j / (ny - 1)
        if inferior_stiff:
            from_stiff_edge = 1.0 - from_stiff_edge
        K = coupling_stiffness(from_stiff_edge, c)
        for i in range(nx):
            fields[0, j, i] = i * dx * opening + j * dy * leaning
            fields[1, j, i] = rho_s
            fields[2, j, i] = 1.0
            fields[3, j, i] = G_t / dy**2
            fields[4, j, i] = eta_t / dy**2
            fields[5, j, i] = K
            fields[6, j, i] = c.C_coup_pa_s_m
            fields[7, j, i] = c.K_col_pa_m
            fields[8, j, i] = c.C_col_pa_s_m
    for k in range(patches.shape[0]):
        patch = patches[k]
        mass, stiff, viscous = patch[5] - 1.0, patch[6] - 1.0, patch[7] - 1.0
        for j in range(ny):
            for i in range(nx):
                x, y = i * dx, j * dy
                s = weight(x, y, length, thickness, patch)
                if 0 < i < nx - 1:  # the ends of the fold are fixed
                    fields[0, j, i] -= patch[4] * s
                fields[1, j, i] *= 1.0 + mass * s
                fields[2, j, i] *= 1.0 + stiff * weight(x + 0.5 * dx, y, length, thickness, patch)
                half_row = weight(x, y + 0.5 * dy, length, thickness, patch)
                fields[3, j, i] *= 1.0 + stiff * half_row
                fields[4, j, i] *= 1.0 + viscous * half_row
                fields[5, j, i] *= 1.0 + stiff * s
                fields[6, j, i] *= 1.0 + viscous * s
                fields[7, j, i] *= 1.0 + stiff * s
                fields[8, j, i] *= 1.0 + viscous * s
