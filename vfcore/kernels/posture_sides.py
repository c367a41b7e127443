"""Posturing statics of a larynx with two different sides: eight equations and their exact Jacobian.

Each side s has its own arytenoid; the cricothyroid joint is common. Unknowns
u = (ξ_l, ψ_l, θ_l, ξ_r, ψ_r, θ_r, ε_t, ε_r). With r0 … r4 of posture_equations.py, written for each side with its own
muscles, joint, activation and arytenoid and with the common ε_t and ε_r:

    0 = r0, r1, r2 of the left;   0 = r0, r1, r2 of the right;   0 = (r3_left + r3_right)/2, (r4_left + r4_right)/2

The spring terms of r3 and r4 are common, so the last two rows are the joint under the mean of both sides' F_CT and of
both sides' F_TA + F_lig + F_muc. The strain of a side is ε_t + ε_r + its own ε_a.

The lateral coordinate ξ of each side points away from the midline. Left and right processes touch when

    ξ_02,l + ξ_02,r ≤ 0

and then meet in a sagittal plane, m to the left of the midline (m < 0: to the right). The collision law of each side is
that of one side with the plane in place of the midline: ξ_l − m in place of ξ_l, ξ_r + m in place of ξ_r. Both
processes are then beyond the plane, because m lies between ξ_02,l and −ξ_02,r. It lies where the lateral contact
forces balance:

    b(m) = F_x,col,l(ξ_l − m, θ_l) − F_x,col,r(ξ_r + m, θ_r) = 0

F_x,col,l vanishes at m = ξ_02,l and F_x,col,r at m = −ξ_02,r, and b rises with m wherever F_x,col pushes the process
back. So b has one root in that interval. Newton's method finds it from the middle of the interval, with bisection where
a step leaves it. m is no unknown of the system: with ∂m/∂u = −(∂b/∂u)/(∂b/∂m) the Jacobian of the eight equations
remains exact. Contact starts without a jump, with a kink of J, as on one side. For equal sides b vanishes in the
middle, m = 0, and each side has the equations of one side.

The mirrored posture of equal sides is always a root. It may be one that the path from rest does not reach: where the
processes press hard, a small shift of the plane can let one arytenoid turn further in and make the other give way. In
the set palaparthi2019 det J has the wrong sign there for a seventh of the random activations that close the glottis,
and a slight difference of the sides moves the plane by up to 2.5 mm. In the other three sets this was not found. It
comes from the published F_x,col: with a balance of T R in its place, it was found in no set.

F_x,col is taken as published, without the factor 1/R (posture_equations.py). Where the joints of the sides differ in R,
the plane depends on that. The forward forces F_y,col of two different sides do not balance, as the published law has
no friction and no reaction in y.

Algebraic: no discretisation. SI units. Twin: tests/support/posture_twin.py. Source: the equations of one side, Titze &
Hunter (2007); the coupling of two sides is this project's. Not validated: no measured posture of a larynx with two
different sides was compared.
"""

import math

from vfcore.kernels.jit import inlined
from vfcore.kernels.posture_equations import collision, equilibrium, stiffening

PLANE_STEP = 1e-11  # m; Newton's method is quadratic, so the error after such a step is below 1e-17 m
PLANE_LIMIT = 60  # iterations

collision_of_side = inlined(collision)


@inlined
def place_side(first, u, activation, passive, muscles, free, part, r, jac):
    """Add the equations of one side without collision; return its ξ_02 and ε̄.

    ``first``: row of its ξ, 0 or 3. ``free``: its joints with collision_ratio 0. ``part`` (7, 5) is scratch.
    The common rows get half of this side's.
    """
    own, own_r, own_jac = part[0], part[1], part[2:7]
    for a in range(3):
        own[a] = u[first + a]
    own[3], own[4] = u[6], u[7]
    xi_02, strain = equilibrium(own, activation, passive, muscles, free, own_r, own_jac)
    for a in range(3):
        r[first + a] = own_r[a]
        for b in range(3):
            jac[first + a, first + b] = own_jac[a, b]
        for b in range(2):
            jac[first + a, 6 + b] = own_jac[a, 3 + b]
    for a in range(2):
        r[6 + a] += 0.5 * own_r[3 + a]
        for b in range(3):
            jac[6 + a, first + b] = 0.5 * own_jac[3 + a, b]
        for b in range(2):
            jac[6 + a, 6 + b] += 0.5 * own_jac[3 + a, 3 + b]
    return xi_02, strain


@inlined
def side_in_contact(theta, j):
    """What the collision of one side needs in addition to ξ: X, Y, κ, ∂κ/∂θ_a, and F_x/T."""
    X, Y = j.x_CAJ_m - j.vocal_process_x_m, j.y_CAJ_m
    k, dk = stiffening(theta, j.kappa_quadratic_rad2, j.kappa_quartic_rad4, j.kappa_limit_rad)
    return X, Y, j.kappa_n_m_rad * k, j.kappa_n_m_rad * dk, -X * math.cos(theta) + Y * math.sin(theta)


@inlined
def contact_plane(u, low, high, left, right):
    """The m between ``low`` = ξ_02,l and ``high`` = −ξ_02,r where the lateral contact forces balance."""
    X_l, Y_l, kappa_l, slope_l, arm_l = side_in_contact(u[2], left)
    X_r, Y_r, kappa_r, slope_r, arm_r = side_in_contact(u[5], right)
    m = 0.5 * (low + high)
    for _ in range(PLANE_LIMIT):
        T_l, T_xi_l, _unused, _unused = collision_of_side(u[0] - m, X_l, Y_l, u[2], kappa_l, slope_l, left)
        T_r, T_xi_r, _unused, _unused = collision_of_side(u[3] + m, X_r, Y_r, u[5], kappa_r, slope_r, right)
        balance = T_l * arm_l - T_r * arm_r
        b_m = -T_xi_l * arm_l - T_xi_r * arm_r
        if b_m == 0.0:  # no collision stiffness: every plane balances
            break
        if balance > 0.0:
            high = m
        else:
            low = m
        following = m - balance / b_m
        if not low <= following <= high:
            following = 0.5 * (low + high)
        move = abs(following - m)
        m = following
        if move <= PLANE_STEP:
            break
    return m


@inlined
def add_collision(first, sign, m, u, j, r, jac):
    """Add the collision of one side at a fixed plane m; return F_x,col, its derivatives by ξ and θ_a, and ∂(F, τ)/∂ξ.

    ``first``: row of its ξ; ``sign``: 1 left, −1 right.
    """
    theta = u[first + 2]
    X, Y, kappa, kappa_slope, arm = side_in_contact(theta, j)
    T, T_xi, T_theta, R = collision_of_side(u[first] - sign * m, X, Y, theta, kappa, kappa_slope, j)
    c, s = math.cos(theta), math.sin(theta)
    arms = (arm, -Y * c - X * s, R)
    arm_slopes = (X * s + Y * c, Y * s - X * c, 0.0)
    for a in range(3):
        r[first + a] += T * arms[a]
        jac[first + a, first] += T_xi * arms[a]
        jac[first + a, first + 2] += T_theta * arms[a] + T * arm_slopes[a]
    return T * arm, T_xi * arm, T_theta * arm + T * arm_slopes[0], (T_xi * arm, T_xi * arms[1], T_xi * R)


@inlined
def equilibrium_of_sides(u, activation, passive, larynx, r, jac):
    """Fill ``r``, the eight equations and b, and ``jac`` = ∂r/∂u of the eight; return ξ_02, ε̄ of each side, and m.

    ``activation`` (10,): left, then right. ``larynx``: for the left, then the right, its muscles, its joints and its
    joints with collision_ratio 0; and scratch (2, 7, 5). ``r`` (9,); ``jac`` (8, 8 or more columns, the rest unused).
    Without contact b = 0, and m is the middle between the processes.
    """
    muscles_l, left, free_l, muscles_r, right, free_r, parts = larynx
    for a in range(8):
        r[a] = 0.0
        for b in range(8):
            jac[a, b] = 0.0
    r[8] = 0.0
    xi_02_l, strain_l = place_side(0, u, activation[:5], passive, muscles_l, free_l, parts[0], r, jac)
    xi_02_r, strain_r = place_side(3, u, activation[5:], passive, muscles_r, free_r, parts[1], r, jac)
    m = 0.5 * (xi_02_l - xi_02_r)
    if xi_02_l + xi_02_r <= 0.0:
        m = contact_plane(u, xi_02_l, -xi_02_r, left, right)
        F_l, F_xi_l, F_theta_l, load_xi_l = add_collision(0, 1.0, m, u, left, r, jac)
        F_r, F_xi_r, F_theta_r, load_xi_r = add_collision(3, -1.0, m, u, right, r, jac)
        r[8] = F_l - F_r
        b_m = -F_xi_l - F_xi_r
        if b_m != 0.0:
            for column, b_u in ((0, F_xi_l), (2, F_theta_l), (3, -F_xi_r), (5, -F_theta_r)):
                m_u = -b_u / b_m
                for a in range(3):
                    jac[a, column] -= load_xi_l[a] * m_u
                    jac[3 + a, column] += load_xi_r[a] * m_u
    return xi_02_l, strain_l, xi_02_r, strain_r, m
