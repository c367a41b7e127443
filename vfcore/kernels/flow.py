"""Quasi-steady viscous Bernoulli flow through one slice of the glottis (paper, "Aerodynamic pressure").

Per slice of width dx at fixed x, y from 0 (superior, outlet) to b (inferior, inlet):

    d_g   = 2 max(G − w, 0)                                gap                  [eq. LocalGapHeight]
    d_min = min_y d_g                                                           [eq. MinimumGap]
    d_sep = min(α_s d_min, d_max)                          gap at separation
    p     = P_s − ½ρ_a (q/d_g)² − 12 μ_a q ∫_y^b dη/d_g³   attached, y ≥ y_sep  [eq. ViscousBernoulliPressure]
    p     = 0                                              downstream of y_sep
    A q² + B q − P_s = 0,  A = ½ρ_a/d_sep²,  B = 12 μ_a ∫_{y_sep}^b dη/d_g³     [eq. FlowRateQuadratic]

with q = −dq_g/dx > 0 towards the mouth, m²/s. The root is taken in the form that does not
cancel and, multiplied by d_sep, needs no reciprocal of a gap that may be 0:

    q = 2P_s/(B + √(B² + 4AP_s)) = 2P_s d_sep/(B d_sep + √((B d_sep)² + 2ρ_a P_s))

The integral follows the trapezoid rule. What is summed is 1/d³ at both ends of each node spacing; the factor dy/2
stands in 12 μ_a dy/2 = ``six_mu_a_dy``.

``d_max``, the largest gap of the slice, bounds d_sep: where α_s d_min exceeds every gap of the
slice the flow separates at the inlet. y_sep is the first node, read from the inlet, whose gap
has fallen to d_sep; a node is attached when the smallest gap from the inlet up to it (the
running minimum) exceeds d_sep. In a closed slice (d_min = 0) nothing flows; nodes from the
inlet down to and including the first contact carry P_s  [eq. AerodynamicPressureClosed].

The integral from the inlet to a node does not ask where the flow separates: B takes its value at the first node that is
not attached, and attached nodes their own.
"""

from vfcore.kernels.jit import jit
from vfcore.kernels.lanes import maximum, minimum, square_root, where

# A reciprocal needs a gap above zero, and its cube must fit single precision. 10 pm is four orders below any gap that
# passes flow.
SMALLEST_GAP_M = 1e-11


@jit
def half_gap(G, w):
    """Half the local gap height d_g, m; SMALLEST_GAP_M / 2 where the fold meets the medial plane."""
    return maximum(G - w, 0.5 * SMALLEST_GAP_M)


@jit
def gap(G, w):
    """Local gap height d_g, m; SMALLEST_GAP_M where the fold meets the medial plane."""
    return 2.0 * half_gap(G, w)


@jit
def is_open(d_min):
    """False for a slice whose folds meet somewhere."""
    return d_min > SMALLEST_GAP_M


@jit
def opening(d_min):
    """The smallest gap of a slice as it counts for its area, m: 0 when closed."""
    return where(is_open(d_min), d_min, 0.0)


@jit
def separation_gap(d_min, d_max, alpha_s):
    """d_sep, m."""
    return minimum(alpha_s * d_min, d_max)


@jit
def attached(running_min, running_min_upstream, d_sep, d_min):
    """True where the flow is attached (open slice) or the node is on the lung side (closed slice).

    The running minima and ``d_sep`` may be halves, all three; ``d_min`` is the whole gap.
    """
    return where(is_open(d_min), running_min, running_min_upstream) > d_sep


@jit
def reciprocals(half_1, half_2):
    """1/d₁ and 1/d₂, m⁻¹, from d₁/2 and d₂/2: one division for both, which costs more than the products do."""
    per_product = 0.5 / (half_1 * half_2)
    return per_product * half_2, per_product * half_1


@jit
def square(r):
    """1/d² from 1/d, m⁻²."""
    return r * r


@jit
def cube(r):
    """1/d³ from 1/d, m⁻³."""
    return square(r) * r


@jit
def viscous_segment(cube_0, cube_1):
    """Trapezoid of ∫ dη/d³ over one node spacing, in units of dy/2, from 1/d³ at both ends, m⁻³."""
    return cube_0 + cube_1


@jit
def size(x):
    """|x|."""
    return maximum(x, 0.0 - x)


@jit
def viscous_drop(viscous_sum, d_sep, six_mu_a_dy):
    """B d_sep of a slice, Pa·s/m."""
    return six_mu_a_dy * viscous_sum * d_sep


@jit
def flux_root(P_s, Bd, half_rho_a):
    """√((B d_sep)² + 2ρ_a P_s), of the size of the drop."""
    return square_root(Bd * Bd + 4.0 * half_rho_a * size(P_s))


@jit
def slice_flux(P_s, d_min, d_sep, Bd, root):
    """Flow per unit width q, m²/s, under the drop ``P_s`` from inlet to outlet; odd in it, and 0 in a closed slice."""
    return where(is_open(d_min), 2.0 * P_s * d_sep / (Bd + root + 1e-30), 0.0)


@jit
def pressure(P_s, q, per_d2, viscous_sum, half_rho_a, six_mu_a_dy):
    """p_aero at an attached node, Pa, with ``P_s`` at the inlet; ``per_d2`` is 1/d²."""
    return P_s - half_rho_a * q * size(q) * per_d2 - six_mu_a_dy * q * viscous_sum
