"""Forces on the mucosa per unit area (paper, eq. MembraneEqn), second-order stencils.

tension    T̃_m ∂_xx w       →  T̃_m/dx² (w_{i−1} − 2 w_i + w_{i+1})
coupling   K_coup(y)(w_m − w_b) + C_coup(ẇ_m − ẇ_b)

shear, ``kelvin_voigt``: ∂_y(G̃ ∂_y w + η̃ ∂_y ẇ); flux on half nodes j+½,

    F_{j+½} = (G̃/dy)(w_{j+1} − w_j) + (η̃/dy)(ẇ_{j+1} − ẇ_j)
    shear_j = (F_{j+½} − F_{j−½})/dy        edges (no flux): the flux beyond mirrors the one within

Linear, so F_{j+½} is the difference of two numbers of which each row has one, (G̃ w_j + η̃ ẇ_j)/dy.

shear, ``rotation``: the same with ∂_y w − φ in place of ∂_y w; φ lives on the half nodes and
obeys  J_m φ̈ = G_m(∂_y w − φ) + η_m(∂_y ẇ − φ̇)   [eq. RotationMembrane].
"""

from vfcore.kernels.jit import jit


@jit
def tension(w_before, w, w_after, T_over_dx2):
    """T̃_m ∂_xx w, Pa."""
    return T_over_dx2 * (w_before - 2.0 * w + w_after)


@jit
def coupling(w_m, v_m, w_b, beam_damper, K_coup, C_coup):
    """Traction between membrane and beam, Pa; pulls the membrane towards the beam. ``beam_damper``: C_coup ẇ_b."""
    return K_coup * (w_m - w_b) + (C_coup * v_m - beam_damper)


@jit
def kelvin_voigt(w, v, G, eta):
    """G w + η v. Linear: the flux between two rows is the difference of their values, less that of dy φ and dy φ̇."""
    return G * w + eta * v
