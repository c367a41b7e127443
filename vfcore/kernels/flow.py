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

The integral follows the trapezoid rule. What is summed is 1/d³ at both ends of each node spacing, so each node's twice,
once on the way to it and once on the way from it; the factor dy/2 stands in 12 μ_a dy/2 = ``six_mu_a_dy``.

``d_max``, the largest gap of the slice, bounds d_sep: where α_s d_min exceeds every gap of the
slice the flow separates at the inlet. y_sep is the first node, read from the inlet, whose gap
has fallen to d_sep; a node is attached when the smallest gap from the inlet up to it (the
running minimum) exceeds d_sep. In a closed slice (d_min = 0) nothing flows; nodes from the
inlet down to and including the first contact carry P_s  [eq. AerodynamicPressureClosed].

So the node of the first contact jumps from 0 to P_s when its slice closes, and back to 0 when the folds meet nearer to
the inlet. A force of the step acts from half a step before its time t_n to half a step after; of a pressure that jumps
in between only the share counts for which it is there. With g_j the smallest of G − w from the inlet down to row j
(half a gap; negative in contact), which changes by Δ a step, the folds meet somewhere between inlet and j during

    s_j = ½ − g_j/Δ,  within 0 and 1,    p_j = (s_0 − s_{j+1}) P_s,  at least 0,  where the flow is not attached

of the step; s_{j+1} = 0 at the inlet. Attached nodes need no share: as the slice closes, q and with it their loss of
pressure go to 0 by themselves. For Δ the step takes how much g_0, the smallest of the slice, has changed in the step
before, and what the pressure that comes and goes would move it in one, P_s dt²/ρ_s: rounding would else throw a slice
that hovers at closure to and fro. Without shares a voice whose period is a whole number of steps jumps in the same part
of a step in every cycle, and the error does not average out.

The integral from the inlet to a node does not ask where the flow separates: B takes its value at the first node that is
not attached, and attached nodes their own.
"""

from vfcore.kernels.jit import jit
from vfcore.kernels.simd import maximum, minimum, multiply_add, square_root, where

# A reciprocal needs a gap above zero, and its cube must fit single precision. 10 pm is four orders below any gap that
# passes flow.
SMALLEST_GAP_M = 1e-11
#: Keeps 1/Δ finite where nothing moves.
STILL_M = 1e-12
#: Keeps the flux finite where no pressure drives it, Pa·s/m; a millionth of a Pascal makes a thousandth of that unit.
SMALLEST_ROOT = 1e-12


@jit
def above_zero(half):
    """Half the local gap height d_g, m, from G − w; SMALLEST_GAP_M / 2 where the fold meets the medial plane."""
    return maximum(half, 0.5 * SMALLEST_GAP_M)


@jit
def gap(G, w):
    """Local gap height d_g, m; SMALLEST_GAP_M where the fold meets the medial plane."""
    return 2.0 * above_zero(G - w)


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
def attached(running_min, d_sep):
    """True where the flow is attached or, in a closed slice, at rest on the lung side of the first contact.

    Both numbers may be halves; ``running_min`` is the smallest gap from the inlet to the node.
    """
    return running_min > d_sep


@jit
def change(half_min, half_min_before, pushed):
    """Δ, m: how much the smallest half gap of a slice has changed in the last step, and what the pressure that jumps
    would move it in one, ``pushed``.
    """
    return size(half_min - half_min_before) + pushed + STILL_M


@jit
def share_shut(half_min, per_change):
    """s_0, the share of the step in which the slice is shut somewhere; ``per_change`` is 1/Δ, m⁻¹."""
    return minimum(maximum(0.5 - half_min * per_change, 0.0), 1.0)


@jit
def share_held(upstream, per_change, shut):
    """(s_0 − s_{j+1})⁺, the share of the step in which a node that is not attached holds the lung pressure.

    ``upstream``: the smallest half gap from the inlet to the node before it, m; ``shut`` is s_0.
    """
    return maximum(minimum(upstream * per_change + (shut - 0.5), shut), 0.0)


@jit
def reciprocals(half_1, half_2):
    """1/d₁ and 1/d₂ from d₁/2 and d₂/2: one division for both, which costs more than the products do."""
    per_product = 0.5 / (half_1 * half_2)
    return per_product * half_2, per_product * half_1


@jit
def square(r):
    """1/d² from 1/d, m⁻²."""
    return r * r


@jit
def half_segment(viscous_sum, per_d2, r):
    """∫ dη/d³ half a node spacing further, towards a node or away from it, in units of dy/2, m⁻³.

    ``per_d2`` and ``r``: 1/d² and 1/d at that node.
    """
    return multiply_add(per_d2, r, viscous_sum)


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
    """√((B d_sep)² + 2ρ_a P_s), of the size of the drop; SMALLEST_ROOT without one."""
    return square_root(Bd * Bd + 4.0 * half_rho_a * size(P_s)) + SMALLEST_ROOT


@jit
def slice_flux(P_s, d_min, d_sep, per_sum):
    """Flow per unit width q, m²/s, under the drop ``P_s`` from inlet to outlet; odd in it, and 0 in a closed slice.

    ``per_sum``: 1/(B d_sep + √(…)).
    """
    return where(is_open(d_min), 2.0 * P_s * d_sep * per_sum, 0.0)


@jit
def pressure(P_s, q, per_d2, viscous_sum, half_rho_a, six_mu_a_dy):
    """p_aero at an attached node, Pa, with ``P_s`` at the inlet; ``per_d2`` is 1/d²."""
    return P_s - half_rho_a * q * size(q) * per_d2 - six_mu_a_dy * q * viscous_sum
