"""Quasi-steady viscous Bernoulli flow through one slice of the glottis (paper, "Aerodynamic pressure").

Per slice of width dx at fixed x, y from 0 (superior, outlet) to b (inferior, inlet):

    d_g   = 2 max(G − w, 0)                                gap                  [eq. LocalGapHeight]
    d_min = min_y d_g                                                           [eq. MinimumGap]
    d_sep = min(α_s d_min, d_max)                          gap at separation
    p     = P_s − ½ρ_a (q/d_g)² − 12 μ_a q ∫_y^b dη/d_g³   attached, y ≥ y_sep  [eq. ViscousBernoulliPressure]
    p     = 0                                              downstream of y_sep
    A q² + B q − P_s = 0,  A = ½ρ_a/d_sep²,  B = 12 μ_a ∫_{y_sep}^b dη/d_g³     [eq. FlowRateQuadratic]

with q = −dq_g/dx > 0 towards the mouth, m²/s. The root is taken in the form that does not
cancel, q = 2P_s/(B + √(B² + 4AP_s)).

``d_max``, the largest gap of the slice, bounds d_sep: where α_s d_min exceeds every gap of the
slice the flow separates at the inlet. y_sep is the first node, read from the inlet, whose gap
has fallen to d_sep; a node is attached when the smallest gap from the inlet up to it (the
running minimum) exceeds d_sep. In a closed slice (d_min = 0) nothing flows; nodes from the
inlet down to and including the first contact carry P_s  [eq. AerodynamicPressureClosed].
"""

from vfcore.kernels.jit import jit
from vfcore.kernels.lanes import maximum, minimum, square_root, where

# A reciprocal needs a gap above zero. 1 pm is five orders below any gap that passes flow.
SMALLEST_GAP_M = 1e-12


@jit
def gap(G, w):
    """Local gap height d_g, m."""
    return 2.0 * maximum(G - w, 0.0)


@jit
def reciprocal(d):
    """1/d, with d kept above SMALLEST_GAP_M."""
    return 1.0 / maximum(d, SMALLEST_GAP_M)


@jit
def separation_gap(d_min, d_max, alpha_s):
    """d_sep, m."""
    return minimum(alpha_s * d_min, d_max)


@jit
def attached(running_min, running_min_upstream, d_sep, d_min):
    """True where the flow is attached (open slice) or the node is on the lung side (closed slice)."""
    return where(d_min > 0.0, running_min, running_min_upstream) > d_sep


@jit
def cube(r):
    """1/d³ from 1/d, m⁻³."""
    return r * r * r


@jit
def viscous_segment(cube_0, cube_1, half_dy):
    """Trapezoid of ∫ dη/d³ over one node spacing, from 1/d³ at both ends, m⁻²."""
    return half_dy * (cube_0 + cube_1)


@jit
def slice_flux(P_s, viscous_integral, d_sep, d_min, half_rho_a, twelve_mu_a):
    """Flow per unit width q, m²/s; 0 in a closed slice."""
    r = reciprocal(d_sep)
    A = half_rho_a * r * r
    B = twelve_mu_a * viscous_integral
    q = 2.0 * P_s / (B + square_root(B * B + 4.0 * A * P_s) + 1e-30)
    return where(d_min > 0.0, q, 0.0)


@jit
def pressure(P_s, q, r, viscous_integral, half_rho_a, twelve_mu_a):
    """p_aero at an attached node, Pa."""
    return P_s - half_rho_a * q * q * r * r - twelve_mu_a * q * viscous_integral
