"""Forces on the mucosa per unit area (paper, eq. MembraneEqn), second-order stencils.

tension    T̃_m ∂_xx w       →  T̃_m/dx² (w_{i−1} − 2 w_i + w_{i+1})
coupling   K_coup(y)(w_m − w_b) + C_coup(ẇ_m − ẇ_b)

shear, ``kelvin_voigt``: ∂_y(G̃ ∂_y w + η̃ ∂_y ẇ); flux on half rows j+½,

    F_{j+½} = (G̃/dy)(w_{j+1} − w_j) + (η̃/dy)(ẇ_{j+1} − ẇ_j)
    shear_j = (F_{j+½} − F_{j−½})/dy        edge rows (no flux through the edge): F beyond the edge is −F within

F is linear, so F_{j+½} is the difference of (G̃ w + η̃ ẇ)/dy between rows j+1 and j; each row computes its own once.

shear, ``rotation``: the same with ∂_y w − φ in place of ∂_y w; φ is defined on the half rows and
obeys  J_m φ̈ = G_m(∂_y w − φ) + η_m(∂_y ẇ − φ̇)   [eq. RotationMembrane].

w in m, ẇ in m/s, T̃_m/dx² in Pa/m, K_coup in Pa/m, C_coup in Pa·s/m; floats or SIMD vectors. Second order in dx and dy.
The explicit step limits 4 T̃_m/dx² + 4 G̃/dy² and 4 η̃/dy² (vfcore/fold/stability.py).
"""

from vfcore.kernels.jit import jit


@jit
def tension(w_before, w, w_after, T_over_dx2):
    """T̃_m ∂_xx w, Pa."""
    return T_over_dx2 * (w_before - 2.0 * w + w_after)


@jit
def coupling(w_m, v_m, w_b, beam_damper, K_coup, C_coup):
    """Traction between membrane and beam, Pa; it pulls the membrane towards the beam. ``beam_damper``: C_coup ẇ_b."""
    return K_coup * (w_m - w_b) + (C_coup * v_m - beam_damper)


@jit
def kelvin_voigt(w, v, G, eta):
    """G w + η v of one row; the flux between two rows is the difference, less the same of dy φ and dy φ̇ (rotation)."""
    return G * w + eta * v
