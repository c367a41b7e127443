"""Quasi-steady viscous Bernoulli flow through one slice of the glottis (paper, "Aerodynamic pressure").

Per slice of width dx at fixed x/L, y from 0 (superior, outlet) to b (inferior, inlet), with the half opening h of the
two walls: G − w for a fold and its mirror image, [(G − w)_left + (G − w)_right]/2 for two different folds, whose slice
has the mean width and the mean thickness of both:

    d_g   = 2 max(h, 0)                                    gap                  [eq. LocalGapHeight]
    d_min = min_y d_g                                                           [eq. MinimumGap]
    d_sep = min(α_s d_min, d_max)                          gap at separation
    p     = P_s − ½ρ_a (q/d_g)² − 12 μ_a q ∫_y^b dη/d_g³   attached, y ≥ y_sep  [eq. ViscousBernoulliPressure]
    p     = 0                                              downstream of y_sep
    A q² + B q − P_s = 0,  A = ½ρ_a/d_sep²,  B = 12 μ_a ∫_{y_sep}^b dη/d_g³     [eq. FlowRateQuadratic]

with q = −dq_g/dx > 0 towards the mouth, m²/s. The root is written in the form without cancellation. Multiplied by
d_sep it needs no reciprocal of a gap that may be 0:

    q = 2P_s/(B + √(B² + 4AP_s)) = 2P_s d_sep/(B d_sep + √((B d_sep)² + 2ρ_a P_s))

Index form of the integral, trapezoid rule over the node spacing dy, from the inlet row ny−1 down to row j:

    12 μ_a ∫_{y_j}^b dη/d_g³  ≈  12 μ_a (dy/2) Σ_{m=j}^{ny−2} (1/d_m³ + 1/d_{m+1}³)

So each inner node enters twice, once for the spacing before it and once for the spacing after it. ``half_segment`` adds
one such term; the factor 12 μ_a dy/2 is ``six_mu_a_dy``.

``d_max``, the largest gap of the slice, bounds d_sep: if α_s d_min exceeds every gap of the slice, the flow separates
at the inlet. y_sep is the first node, read from the inlet, whose gap is at most d_sep. A node is attached if the
running minimum (the smallest gap from the inlet to the node) exceeds d_sep. A closed slice (d_min = 0) has no flow;
nodes from the inlet down to and including the first contact carry P_s  [eq. AerodynamicPressureClosed].

The pressure at the node of first contact therefore jumps from 0 to P_s when its slice closes, and back to 0 when the
folds meet nearer to the inlet. A force acts from half a step before its time t_n to half a step after it. If the
pressure jumps within that interval, only the fraction of the step during which it acts counts. Let g_j be the smallest
h from the inlet down to row j (half a gap; negative in contact) and Δ its change per step. The folds meet somewhere
between inlet and row j during the fraction s_j of the step:

    s_j = ½ − g_j/Δ,  within 0 and 1,    p_j = (s_0 − s_{j+1}) P_s,  at least 0,  if the flow is not attached

with s_{j+1} = 0 at the inlet. Attached nodes need no such fraction: as the slice closes, q and the pressure loss at
these nodes go to 0 continuously. Δ is the change of g_0, the smallest of the slice, during the previous step, plus the
distance P_s dt²/ρ_s by which the jumping pressure would move the membrane in one step. Without the second term,
rounding would make a slice that hovers at closure oscillate. Without the fractions, a voice whose period is a whole
number of steps has its jumps at the same part of a step in every cycle, and the error does not average out.

The integral from the inlet to a node does not depend on where the flow separates: B takes its value at the first node
that is not attached, each attached node its own.

Every function takes floats or SIMD vectors (kernels/simd.py). SI units. First order in dy, because the air pressure
ends on a node, both at separation and at closure; the trapezoid rule itself is second order. No stability bound of its
own (docs/model/numerics.md). Verified in tests/physics/test_flow_*.py; not validated against measured pressures.
"""

from vfcore.kernels.elementary import abs_
from vfcore.kernels.jit import jit
from vfcore.kernels.simd import maximum, minimum, multiply_add, select, square_root

# A reciprocal needs a gap above zero, and its cube must fit in single precision. 10 pm is four orders of magnitude
# below any gap with noticeable flow.
SMALLEST_GAP_M = 1e-11
#: Of the glottis: α_s, ½ρ_a, 12 μ_a.
NUMBERS = ("alpha_s", "half_rho_a", "twelve_mu_a")
#: Keeps 1/Δ finite when nothing moves.
MIN_GAP_CHANGE_M = 1e-12
#: Keeps the flux finite at zero pressure, Pa·s/m. A pressure of 1 µPa makes a root of the order of 1e-3.
SMALLEST_ROOT = 1e-12


@jit
def above_zero(half):
    """Half the local gap height d_g, m, from the half opening; SMALLEST_GAP_M / 2 where the folds meet."""
    return maximum(half, 0.5 * SMALLEST_GAP_M)


@jit
def gap(half):
    """Local gap height d_g, m, from half of it; SMALLEST_GAP_M where the folds meet."""
    return 2.0 * above_zero(half)


@jit
def is_open(d_min):
    """False for a slice in which the folds meet."""
    return d_min > SMALLEST_GAP_M


@jit
def opening(d_min):
    """The smallest gap of a slice as it counts towards the glottal area, m: 0 when closed."""
    return select(is_open(d_min), d_min, 0.0)


@jit
def separation_gap(d_min, d_max, alpha_s):
    """d_sep, m."""
    return minimum(alpha_s * d_min, d_max)


@jit
def attached(running_min, d_sep):
    """True where the flow is attached or, in a closed slice, at rest on the lung side of the first contact.

    ``running_min``: the smallest gap from the inlet to the node, m. Both gaps may be half gaps.
    """
    return running_min > d_sep


@jit
def gap_rate(half_min, half_min_before, pushed):
    """Δ, the change of the smallest half gap of a slice per step, m.

    ``pushed``: how far the jumping pressure would move the membrane in one step, m.
    """
    return abs_(half_min - half_min_before) + pushed + MIN_GAP_CHANGE_M


@jit
def closed_fraction(half_min, inv_gap_rate):
    """s_0, the fraction of the step during which the slice is closed; ``inv_gap_rate`` is 1/Δ, m⁻¹."""
    return minimum(maximum(0.5 - half_min * inv_gap_rate, 0.0), 1.0)


@jit
def held_fraction(upstream, inv_gap_rate, closed):
    """(s_0 − s_{j+1})⁺, the fraction of the step during which a node that is not attached holds the lung pressure.

    ``upstream``: the smallest half gap from the inlet to the node upstream of it, m; ``closed`` is s_0.
    """
    return maximum(minimum(upstream * inv_gap_rate + (closed - 0.5), closed), 0.0)


@jit
def reciprocals(half_1, half_2):
    """1/d₁ and 1/d₂ from d₁/2 and d₂/2 with one division, which is slower than the extra products."""
    inv_product = 0.5 / (half_1 * half_2)
    return inv_product * half_2, inv_product * half_1


@jit
def square(r):
    """1/d² from 1/d, m⁻²."""
    return r * r


@jit
def half_segment(viscous_sum, inv_d2, r):
    """Add a node's term 1/d³ to the trapezoid sum Σ 1/d³, m⁻³ (the integral in units of dy/2).

    ``inv_d2`` and ``r``: 1/d² and 1/d at that node.
    """
    return multiply_add(inv_d2, r, viscous_sum)


@jit
def viscous_drop(viscous_sum, d_sep, six_mu_a_dy):
    """B d_sep of a slice, Pa·s/m."""
    return six_mu_a_dy * viscous_sum * d_sep


@jit
def flux_root(P_s, Bd, half_rho_a):
    """√((B d_sep)² + 2ρ_a P_s), in the units of B d_sep; SMALLEST_ROOT at zero pressure and no viscous drop."""
    return square_root(Bd * Bd + 4.0 * half_rho_a * abs_(P_s)) + SMALLEST_ROOT


@jit
def slice_flux(P_s, d_min, d_sep, inv_sum):
    """Flow per unit width q, m²/s, at the pressure drop ``P_s`` from inlet to outlet. Odd in it; 0 in a closed slice.

    ``inv_sum``: 1/(B d_sep + √(…)).
    """
    return select(is_open(d_min), 2.0 * P_s * d_sep * inv_sum, 0.0)


@jit
def pressure(P_s, q, inv_d2, viscous_sum, half_rho_a, six_mu_a_dy):
    """p_aero at an attached node, Pa, with ``P_s`` at the inlet; ``inv_d2`` is 1/d²."""
    return P_s - half_rho_a * q * abs_(q) * inv_d2 - six_mu_a_dy * q * viscous_sum
