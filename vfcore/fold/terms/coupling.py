"""Coupling of membrane and beam (paper, eq. MembraneEqn), and the foundation of the beam (eq. BeamEqn).

    traction    K_coup(y)(w_m − w_b) + C_coup(ẇ_m − ẇ_b)        Pa, pulls the membrane towards the beam
    on the beam ∫_0^b traction dy − K_foun w_b − C_foun ẇ_b     N/m; trapezoid rule over the rows

Node by node: no stencil. w in m, ẇ in m/s, K_coup in Pa/m, C_coup in Pa·s/m; floats or SIMD vectors. The explicit step
limits K_coup and C_coup over the reduced mass of both (vfcore/fold/stability.py). Stored energy per area
½ K_coup (w_m − w_b)², loss C_coup (ẇ_m − ẇ_b)². Not validated on its own.
"""

from vfcore.kernels.jit import formula, jit

NUMBERS = ("C_coup", "K_foun", "C_foun")


@jit
def coupling(w_m, v_m, w_b, beam_damper, K_coup, C_coup):
    """Traction between membrane and beam, Pa; it pulls the membrane towards the beam. ``beam_damper``: C_coup ẇ_b."""
    return K_coup * (w_m - w_b) + (C_coup * v_m - beam_damper)


@formula
def coupling_stiffness(from_stiff_edge, c):
    """K_coup, Pa/m, at a fraction 0 to 1 of the thickness from the stiffer edge."""
    return c.K_coup_max_pa_m + (c.K_coup_min_pa_m - c.K_coup_max_pa_m) * from_stiff_edge
