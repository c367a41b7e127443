"""Re-assembly of a fold at a new posture: every fixed number of the buffer and of the step, in one compiled call.

The numbers and their formulas, with x_i = i dx and y_j = j dy (kernels/tissue.py, kernels/banded.py):

    medial plane          G_ij = x_i tan θ_g + y_j tan θ_conv                       m
    coupling              K_coup,j, linear in y                                     Pa/m
    lines over x          1/ρ_s, dx (half of it at x = L), end moments over ρ_l     m²/kg, m, m/s²
    beam                  (I − dt²A/4)⁻¹ from its banded factors                    1
    scalars of the step   layout.SCALARS

Second order in dx and dy, as the step. A played voice whose parameters move needs this a hundred times a second; array
by array in Python it takes more than ten times as long. Twin: vfcore/fold/assemble.py. Not validated on its own.
"""

import math
from collections.abc import Callable
from functools import lru_cache

from vfcore.kernels.banded import factor, invert
from vfcore.kernels.jit import jit
from vfcore.kernels.layout import Layout
from vfcore.kernels.tissue import (
    beam_bands,
    beam_ends,
    coupling_stiffness,
    longest_step,
    medial_plane,
    prestrained,
    step_numbers,
)


@lru_cache(maxsize=32)
def reassemble_kernel(nx: int, ny: int, rotation: bool) -> Callable[..., float]:
    """The compiled ``fill`` for one grid."""
    L = Layout(nx, ny)
    STRIDE, FIRST, NB, BI, WORKED = L.stride, L.first, nx - 2, L.beam_inverse, L.worked
    G, K = L.field("G") + L.anterior, L.K_coup
    LOAD, INV, WIDTH = (L.line(name) + FIRST for name in ("beam_load", "inverse_density", "width"))
    turns = int(rotation)

    # The closure may hold only plain constants, see vfcore/kernels/fold.py.
    @jit
    def fill(strain, a_ta, theta_g, theta_0, convergence, inferior_stiff, dt, c, buffer, scalars, work):
        """Write what depends on posture and tissue; return the longest stable step without margin, s.

        ``theta_g`` is the half-angle clipped at 0, ``theta_0`` the rest angle, ``convergence`` θ_conv, in rad; ``c`` is
        a kernels.tissue.Constants. ``buffer`` (Layout.size,) must have been filled for the same grid before.
        ``scalars`` (len(SCALARS),) is written; ``work`` (3·(nx−2),) is scratch. Returns NaN if the fold has no
        stiffness left; the numbers written are then meaningless.
        """
        numbers = prestrained(strain, a_ta, c)
        lam, length, b, T, G_t, eta_t, rho_s, J, N_b, mu, M_c, rho_l = numbers[:12]
        axial = numbers[-1]
        if not (axial > 0.0 and T > 0.0 and mu > 0.0):
            return math.nan
        dx, dy = length / (nx - 1), b / (ny - 1)
        opening, leaning = math.tan(theta_g), math.tan(convergence)
        for j in range(ny):
            for i in range(nx):
                buffer[G + j * STRIDE + i] = medial_plane(i * dx, j * dy, opening, leaning)
            from_stiff_edge = j / (ny - 1)
            if inferior_stiff:
                from_stiff_edge = 1.0 - from_stiff_edge
            buffer[K + j] = coupling_stiffness(from_stiff_edge, c)
        for i in range(NB):
            buffer[LOAD + i], buffer[INV + i], buffer[WIDTH + i] = 0.0, 1.0 / rho_s, dx
        buffer[WIDTH + NB] = 0.5 * dx

        ends = beam_ends(dx, mu, lam, M_c, c.K_r_a_n_m, c.K_r_p_n_m, theta_g, theta_0)
        at_0, centre, at_L, first, second, load_0, load_L = beam_bands(dx, N_b, mu, ends)
        buffer[LOAD] = load_0 / rho_l
        buffer[LOAD + NB - 1] += load_L / rho_l
        quarter = 0.25 * dt * dt / rho_l
        for i in range(NB):
            work[i] = 1.0 - quarter * centre
        work[0], work[NB - 1] = 1.0 - quarter * at_0, 1.0 - quarter * at_L
        D, a, c_2 = work[:NB], work[NB : 2 * NB], work[2 * NB : 3 * NB]
        factor(D, -quarter * first, -quarter * second, a, c_2)
        invert(D, a, c_2, buffer[BI:], WORKED)

        values = step_numbers(dt, dx, dy, T, G_t, eta_t, rho_l, J, c)
        for k in range(len(values)):
            scalars[k] = values[k]
        return longest_step(
            turns > 0, dx, dy, T, G_t, eta_t, rho_s, J, b, rho_l, max(c.K_coup_min_pa_m, c.K_coup_max_pa_m), c
        )

    return fill
