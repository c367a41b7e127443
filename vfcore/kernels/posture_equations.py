"""Posturing statics: the five equilibrium equations and their exact Jacobian.

Titze & Hunter (2007), JASA 121(4):2254–2260, as used by Alzamendi et al. (2022), JASA 151(1):17–30, without inertia.
Unknowns u = (ξ m, ψ m, θ_a rad, ε_t, ε_r): cricoarytenoid translation (lateral, anterior) and rotation
(positive turns the vocal process inward), strain of the fold by translation and by rotation of the
cricothyroid joint. X = x_C − x̄_02, Y = y_C, R = |(X, Y)|. Residuals (N, N, N·m, N, N·m):

    r0 = Σ α_i F_i − k_x ξ + F_x,col          r3 = F_CT cos φ − (F_TA + F_lig + F_muc) − k_t L_0 ε_t
    r1 = Σ β_i F_i − k_y ψ + F_y,col          r4 = w F_CT − h (F_TA + F_lig + F_muc) − (L_0/h) k_r ε_r
    r2 = Σ_{i≠CT} γ_i F_i − κ θ_a + τ_col
    vocal process   ξ_02 = x_C − X cos θ_a + Y sin θ_a + ξ
    fold strain     ε̄ = ε_t + ε_r − [Y (1 − cos θ_a) − X sin θ_a + ψ]/L_0
    collision, only when ξ_02 ≤ 0: Δ = θ_a − θ_col with ξ_02(θ_col) = 0, T = −20 (κ/R)(Δ + 500 Δ³),
        F_x = T (−X cos θ_a + Y sin θ_a), F_y = T (−Y cos θ_a − X sin θ_a), τ = T R

Dimensionally F_x,col and F_y,col lack a factor 1/R. The published implementation has none, and neither has this one.
ξ_02 = x_C + ξ − R cos(θ_a − φ), φ = atan2(−Y, X), so θ_col = φ − acos((x_C + ξ)/R) where that exists. Above
x_C + ξ = R the processes cannot meet; below −R (reached by trial steps only) θ_col stays at φ − π.

Algebraic: no discretisation. The Jacobian is exact but for the kinks named in posture.py. Twin:
tests/support/posture_twin.py. Not validated but for published values of strain and angle.
"""

import math
from typing import NamedTuple

from vfcore.kernels.jit import inlined, written_out

# Rows of ``muscles``; the first five are also the order of an activation vector.
TA, CT, LCA, IA, PCA, LIG, MUC = range(7)
# Columns of ``muscles``: the fields of vfcore.spec.muscles.Muscle.
LENGTH, SECTION, EPS_M, WIDTH, ALPHA, BETA, GAMMA, SIGMA_0, SIGMA_2, EPS_1, EPS_2, RATE, SIGMA_MAX = range(13)

LARGEST_EXPONENT = 100.0  # far above any tissue strain; keeps the force finite in a bad trial step


class Joints(NamedTuple):
    """Joint constants as plain floats, SI; names of vfcore.spec.joints.JointConstants."""

    L_0_posture_m: float
    adductor_strain_gain: float
    x_CAJ_m: float
    y_CAJ_m: float
    vocal_process_x_m: float
    k_x_n_m: float
    k_x_quadratic_m2: float
    k_x_quartic_m4: float
    k_x_limit_m: float
    k_y_n_m: float
    k_y_quadratic_m2: float
    k_y_quartic_m4: float
    k_y_limit_m: float
    kappa_n_m_rad: float
    kappa_quadratic_rad2: float
    kappa_quartic_rad4: float
    kappa_limit_rad: float
    collision_ratio: float
    collision_cubic_rad2: float
    cos_phi: float
    h_TA_m: float
    w_CT_m: float
    k_t_n_m: float
    k_t_rotation_rad: float
    k_t_quadratic_m2: float
    k_t_quartic_m4: float
    k_t_limit_m: float
    k_r_n_m_rad: float
    k_r_translation_m: float
    k_r_quadratic_rad2: float
    k_r_quartic_rad4: float
    k_r_limit_rad: float


@inlined
def muscle_force(m, strain, passive, active):
    """Force of one table row, N, and its derivative by strain; ``passive`` scales the passive part."""
    stress, slope = 0.0, 0.0
    if strain > m[EPS_1]:
        slope = -m[SIGMA_0] / m[EPS_1]
        stress = slope * (strain - m[EPS_1])
        if strain > m[EPS_2]:
            z = min(m[RATE] * (strain - m[EPS_2]), LARGEST_EXPONENT)
            e = math.exp(z)
            stress += m[SIGMA_2] * (e - 1.0 - z)
            slope += m[SIGMA_2] * m[RATE] * (e - 1.0)
    stress, slope = passive * stress, passive * slope
    offset = strain - m[EPS_M]
    shape = 1.0 - m[WIDTH] * offset * offset
    if shape > 0.0:
        stress += active * m[SIGMA_MAX] * shape
        slope -= 2.0 * active * m[SIGMA_MAX] * m[WIDTH] * offset
    return m[SECTION] * stress, m[SECTION] * slope


@inlined
def stiffening(z, quadratic, quartic, limit):
    """1 + quadratic z² + quartic ⟨|z| − limit⟩⁴ and its derivative by z."""
    beyond = max(0.0, abs(z) - limit)
    value = 1.0 + quadratic * z * z + quartic * beyond**4
    return value, 2.0 * quadratic * z + math.copysign(4.0 * quartic * beyond**3, z)


@written_out
def collision(xi, X, Y, theta, kappa, kappa_slope, j):
    """T (N) of a process beyond the plane of contact, ∂T/∂ξ, ∂T/∂θ_a, and R; ``xi``: ξ from that plane."""
    R = math.hypot(X, Y)
    q = min(1.0, max(-1.0, (j.x_CAJ_m + xi) / R))
    col_slope = 1.0 / (R * math.sqrt(1.0 - q * q)) if abs(q) < 1.0 else 0.0
    depth = theta - (math.atan2(-Y, X) - math.acos(q))
    law = depth + j.collision_cubic_rad2 * depth**3
    law_slope = 1.0 + 3.0 * j.collision_cubic_rad2 * depth**2
    T = -j.collision_ratio / R * kappa * law
    T_theta = -j.collision_ratio / R * (kappa_slope * law + kappa * law_slope)
    T_xi = j.collision_ratio / R * kappa * law_slope * col_slope
    return T, T_xi, T_theta, R


@inlined
def equilibrium(u, activation, passive, muscles, j, r, jac):
    """Fill ``r`` (5,) and ``jac`` (5, 5) = ∂r/∂u; return ξ_02 (m, signed) and the fold strain ε̄."""
    xi, psi, theta, e_t, e_r = u[0], u[1], u[2], u[3], u[4]
    L_0, h, w = j.L_0_posture_m, j.h_TA_m, j.w_CT_m
    X, Y = j.x_CAJ_m - j.vocal_process_x_m, j.y_CAJ_m
    c, s = math.cos(theta), math.sin(theta)
    strain = e_r + e_t - (Y * (1.0 - c) - X * s + psi) / L_0
    strain_psi, strain_theta = -1.0 / L_0, -(Y * s - X * c) / L_0
    for a in range(5):
        r[a] = 0.0
        for b in range(5):
            jac[a, b] = 0.0

    for i in (LCA, IA, PCA):
        m = muscles[i]
        gain = -j.adductor_strain_gain * m[GAMMA] / m[LENGTH]
        force, slope = muscle_force(m, gain * theta, passive, activation[i])
        for a in range(3):
            r[a] += m[ALPHA + a] * force
            jac[a, 2] += m[ALPHA + a] * slope * gain

    tension, tension_slope = 0.0, 0.0
    for i in (TA, LIG, MUC):
        m = muscles[i]
        force, slope = muscle_force(m, strain, passive, activation[TA] if i == TA else 0.0)
        tension += force
        tension_slope += slope
        for a in range(3):
            r[a] += m[ALPHA + a] * force
            jac[a, 1] += m[ALPHA + a] * slope * strain_psi
            jac[a, 2] += m[ALPHA + a] * slope * strain_theta
            jac[a, 3] += m[ALPHA + a] * slope
            jac[a, 4] += m[ALPHA + a] * slope

    m = muscles[CT]
    ct_t, ct_r = -(L_0 / m[LENGTH]) / j.cos_phi, -(L_0 / m[LENGTH]) * w / h
    force, slope = muscle_force(m, ct_t * e_t + ct_r * e_r, passive, activation[CT])
    for a in range(2):
        r[a] += m[ALPHA + a] * force
        jac[a, 3] += m[ALPHA + a] * slope * ct_t
        jac[a, 4] += m[ALPHA + a] * slope * ct_r
    for a, arm_ct, arm_fold in ((3, j.cos_phi, 1.0), (4, w, h)):
        r[a] = arm_ct * force - arm_fold * tension
        jac[a, 1] = -arm_fold * tension_slope * strain_psi
        jac[a, 2] = -arm_fold * tension_slope * strain_theta
        jac[a, 3] = arm_ct * slope * ct_t - arm_fold * tension_slope
        jac[a, 4] = arm_ct * slope * ct_r - arm_fold * tension_slope

    k, dk = stiffening(xi, j.k_x_quadratic_m2, j.k_x_quartic_m4, j.k_x_limit_m)
    r[0] -= j.k_x_n_m * k * xi
    jac[0, 0] -= j.k_x_n_m * (k + dk * xi)
    k, dk = stiffening(psi, j.k_y_quadratic_m2, j.k_y_quartic_m4, j.k_y_limit_m)
    r[1] -= j.k_y_n_m * k * psi
    jac[1, 1] -= j.k_y_n_m * (k + dk * psi)
    k, dk = stiffening(theta, j.kappa_quadratic_rad2, j.kappa_quartic_rad4, j.kappa_limit_rad)
    kappa, kappa_slope = j.kappa_n_m_rad * k, j.kappa_n_m_rad * dk
    r[2] -= kappa * theta
    jac[2, 2] -= kappa + kappa_slope * theta

    d, a_r = L_0 * e_t, L_0 * e_r / h
    k, dk = stiffening(d, j.k_t_quadratic_m2, j.k_t_quartic_m4, j.k_t_limit_m)
    turned = j.k_t_n_m * (1.0 + j.k_t_rotation_rad * abs(a_r))
    r[3] -= turned * k * d
    jac[3, 3] -= turned * (k + dk * d) * L_0
    jac[3, 4] -= j.k_t_n_m * math.copysign(j.k_t_rotation_rad, a_r) * k * d * L_0 / h
    k, dk = stiffening(a_r, j.k_r_quadratic_rad2, j.k_r_quartic_rad4, j.k_r_limit_rad)
    moved = j.k_r_n_m_rad * (1.0 + j.k_r_translation_m * abs(d))
    r[4] -= moved * k * a_r
    jac[4, 4] -= moved * (k + dk * a_r) * L_0 / h
    jac[4, 3] -= j.k_r_n_m_rad * math.copysign(j.k_r_translation_m, d) * k * a_r * L_0

    xi_02 = j.x_CAJ_m - X * c + Y * s + xi
    if xi_02 <= 0.0:
        T, T_xi, T_theta, R = collision(xi, X, Y, theta, kappa, kappa_slope, j)
        arms = (-X * c + Y * s, -Y * c - X * s, R)
        arm_slopes = (X * s + Y * c, Y * s - X * c, 0.0)
        for a in range(3):
            r[a] += T * arms[a]
            jac[a, 0] += T_xi * arms[a]
            jac[a, 2] += T_theta * arms[a] + T * arm_slopes[a]
    return xi_02, strain
