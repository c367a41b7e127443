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

import math

from vfcore.kernels.jit import jit

# A reciprocal needs a gap above zero. 1 pm is five orders below any gap that passes flow.
SMALLEST_GAP_M = 1e-12


@jit
def gap(G, w):
    """Local gap height d_g, m."""
    return 2.0 * max(G - w, 0.0)


@jit
def reciprocal(d):
    """1/d, with d kept above SMALLEST_GAP_M."""
    return 1.0 / max(d, SMALLEST_GAP_M)


@jit
def separation_gap(d_min, d_max, alpha_s):
    """d_sep, m."""
    return min(alpha_s * d_min, d_max)


@jit
def attached(running_min, running_min_upstream, d_sep, d_min):
    """1.0 where the flow is attached (open slice) or the node is on the lung side (closed slice)."""
    smallest = running_min if d_min > 0.0 else running_min_upstream
    return 1.0 if smallest > d_sep else 0.0


@jit
def viscous_segment(r0, r1, half_dy):
    """Trapezoid of ∫ dη/d³ over one node spacing, from the reciprocal gaps at both ends, m⁻²."""
    return half_dy * (r0 * r0 * r0 + r1 * r1 * r1)


@jit
def slice_flux(drop, viscous_integral, d_sep, d_min, half_rho_a, twelve_mu_a):
    """Flow per unit width q, m²/s, under the drop p(inlet) − p(outlet); odd in it, and 0 in a closed slice."""
    r = reciprocal(d_sep)
    return flux(drop, half_rho_a * r * r, twelve_mu_a * viscous_integral) if d_min > 0.0 else 0.0


@jit
def flux(drop, A, B):
    """q that satisfies A q |q| + B q = drop, m²/s."""
    return 2.0 * drop / (B + math.sqrt(B * B + 4.0 * A * abs(drop)) + 1e-300)


@jit
def pressure(P_s, q, r, viscous_integral, half_rho_a, twelve_mu_a):
    """p_aero at an attached node, Pa."""
    return P_s - half_rho_a * q * abs(q) * r * r - twelve_mu_a * q * viscous_integral
