"""Slow, obvious twin of the posturing statics: one line per equation, roots by scipy.

Nothing here comes from the compiled kernel: forces are dictionaries, the solver is scipy's hybrid
Powell method with finite-difference derivatives, and the continuation is a plain loop.
"""

import numpy as np
from scipy.optimize import brentq, root

# About 1 mm, 1 mm, 0.1 rad, 10 % strain: scipy's solver needs unknowns of similar size.
UNKNOWN_SCALE = np.array([1e-3, 1e-3, 0.1, 0.1, 0.1])


def passive_stress(m, strain):
    """Passive stress of one row of the tables, Pa."""
    if strain < m.epsilon_1:
        return 0.0
    stress = -m.sigma_0_pa / m.epsilon_1 * (strain - m.epsilon_1)
    if strain > m.epsilon_2:
        z = m.exponential_B * (strain - m.epsilon_2)
        stress += m.sigma_2_pa * (np.exp(z) - 1 - z)
    return stress


def force(m, strain, activation):
    """Passive plus active force of one row of the tables, N."""
    shape = max(0.0, 1 - m.active_width_b * (strain - m.strain_at_max_active_stress) ** 2)
    return m.cross_section_m2 * (passive_stress(m, strain) + activation * m.sigma_max_active_pa * shape)


def stiffening(z, quadratic, quartic, limit):
    """1 + quadratic z² + quartic ⟨|z| − limit⟩⁴."""
    return 1 + quadratic * z**2 + quartic * max(0.0, abs(z) - limit) ** 4


def strains(c, unknowns):
    """Strain of the fold and of each muscle, as a dictionary."""
    xi, psi, theta, e_t, e_r = unknowns
    X = c.x_CAJ_m - c.vocal_process_x_m
    e_a = -(c.y_CAJ_m * (1 - np.cos(theta)) - X * np.sin(theta) + psi) / c.L_0_posture_m
    fold = e_r + e_t + e_a
    ct = -(c.L_0_posture_m / c.ct.rest_length_m) * (e_t / c.cos_phi + c.w_CT_m / c.h_TA_m * e_r)
    out = {"ta": fold, "lig": fold, "muc": fold, "ct": ct}
    for key in ("lca", "ia", "pca"):
        m = getattr(c, key)
        out[key] = -c.adductor_strain_gain * m.gamma_m / m.rest_length_m * theta
    return out


def vocal_process_x(c, xi, theta):
    """Lateral position of the vocal process, m; negative beyond the midline."""
    X = c.x_CAJ_m - c.vocal_process_x_m
    return c.x_CAJ_m - X * np.cos(theta) + c.y_CAJ_m * np.sin(theta) + xi


def collision(c, xi, theta, kappa, plane=0.0):
    """Collision force (x, y) and moment on the arytenoid; zeros when the vocal process is lateral of the plane."""
    if vocal_process_x(c, xi, theta) > plane:
        return 0.0, 0.0, 0.0
    X, Y = c.x_CAJ_m - c.vocal_process_x_m, c.y_CAJ_m
    R = np.hypot(X, Y)
    theta_col = np.arctan2(-Y, X) - np.arccos(np.clip((c.x_CAJ_m + xi - plane) / R, -1, 1))
    depth = theta - theta_col
    T = -c.collision_ratio * kappa / R * (depth + c.collision_cubic_rad2 * depth**3)
    return T * (-X * np.cos(theta) + Y * np.sin(theta)), T * (-Y * np.cos(theta) - X * np.sin(theta)), T * R


def rotational_stiffness(c, theta):
    """κ of the cricoarytenoid joint, N·m/rad."""
    return c.kappa_n_m_rad * stiffening(theta, c.kappa_quadratic_rad2, c.kappa_quartic_rad4, c.kappa_limit_rad)


def residual(c, unknowns, activation, plane=0.0):
    """The five equations, N, N, N·m, N, N·m; ``activation`` maps ta, ct, lca, ia, pca to [0, 1].

    ``plane``: distance of the plane of contact from the midline, m, towards this side.
    """
    xi, psi, theta, e_t, e_r = unknowns
    F = {k: force(getattr(c, k), e, activation.get(k, 0.0)) for k, e in strains(c, unknowns).items()}
    fold = F["ta"] + F["lig"] + F["muc"]
    k_x = c.k_x_n_m * stiffening(xi, c.k_x_quadratic_m2, c.k_x_quartic_m4, c.k_x_limit_m)
    k_y = c.k_y_n_m * stiffening(psi, c.k_y_quadratic_m2, c.k_y_quartic_m4, c.k_y_limit_m)
    kappa = rotational_stiffness(c, theta)
    d_t, d_r = c.L_0_posture_m * e_t, c.L_0_posture_m * e_r
    a = d_r / c.h_TA_m
    k_t = c.k_t_n_m * (1 + c.k_t_rotation_rad * abs(a))
    k_t *= stiffening(d_t, c.k_t_quadratic_m2, c.k_t_quartic_m4, c.k_t_limit_m)
    k_r = c.k_r_n_m_rad * (1 + c.k_r_translation_m * abs(d_t))
    k_r *= stiffening(a, c.k_r_quadratic_rad2, c.k_r_quartic_rad4, c.k_r_limit_rad)
    col_x, col_y, col_moment = collision(c, xi, theta, kappa, plane)
    return np.array(
        [
            sum(getattr(c, k).alpha * f for k, f in F.items()) - k_x * xi + col_x,
            sum(getattr(c, k).beta * f for k, f in F.items()) - k_y * psi + col_y,
            sum(getattr(c, k).gamma_m * f for k, f in F.items() if k != "ct") - kappa * theta + col_moment,
            F["ct"] * c.cos_phi - fold - k_t * d_t,
            c.w_CT_m * F["ct"] - c.h_TA_m * fold - k_r * a,
        ]
    )


def solve(c, activation, steps=40, start=None):
    """Unknowns (ξ, ψ, θ_a, ε_t, ε_r), by raising all activations from rest in equal steps."""
    z = np.zeros(5) if start is None else np.asarray(start) / UNKNOWN_SCALE
    weight = np.array([1, 1, 100, 1, 100])
    for s in np.linspace(0, 1, steps + 1) if start is None else [1.0]:
        part = {k: s * a for k, a in activation.items()}
        found = root(lambda z, part=part: weight * residual(c, z * UNKNOWN_SCALE, part), z, tol=1e-13)
        z = found.x
    return z * UNKNOWN_SCALE


def strain_and_half_angle(c, unknowns):
    """Fold strain and raw glottal half-angle (rad) of a solution."""
    strain = strains(c, unknowns)["ta"]
    return strain, np.arctan(vocal_process_x(c, unknowns[0], unknowns[2]) / (c.L_0_posture_m * (1 + strain)))


def arytenoids(unknowns):
    """The unknowns of each side, (ξ, ψ, θ_a, ε_t, ε_r), of the eight of a larynx with two sides."""
    return np.concatenate([unknowns[:3], unknowns[6:8]]), np.concatenate([unknowns[3:6], unknowns[6:8]])


def contact_forces(left, right, unknowns, plane):
    """Lateral contact force on the left and on the right arytenoid with the plane ``plane`` left of the midline."""
    own = arytenoids(unknowns)
    return [
        collision(c, u[0], u[2], rotational_stiffness(c, u[2]), sign * plane)[0]
        for c, u, sign in zip((left, right), own, (1, -1), strict=True)
    ]


def process_positions(left, right, unknowns):
    """ξ_02 of the left and of the right, each from the midline towards its side."""
    return [vocal_process_x(c, u[0], u[2]) for c, u in zip((left, right), arytenoids(unknowns), strict=True)]


def plane_of_contact(left, right, unknowns):
    """The plane between the two processes where the lateral contact forces balance; without contact the middle."""
    xi_l, xi_r = process_positions(left, right, unknowns)
    if xi_l + xi_r >= 0:
        return (xi_l - xi_r) / 2

    def balance(plane):
        forces = contact_forces(left, right, unknowns, plane)
        return forces[0] - forces[1]

    return brentq(balance, xi_l, -xi_r, xtol=1e-16)


def residual_of_sides(left, right, unknowns, left_activation, right_activation, plane):
    """The eight equations: three of each arytenoid, and the mean of both sides for the cricothyroid joint."""
    ia = (left_activation["ia"] + right_activation["ia"]) / 2
    own = arytenoids(unknowns)
    r_l = residual(left, own[0], left_activation | {"ia": ia}, plane)
    r_r = residual(right, own[1], right_activation | {"ia": ia}, -plane)
    return np.concatenate([r_l[:3], r_r[:3], (r_l[3:] + r_r[3:]) / 2])


def solve_sides(left, right, left_activation, right_activation, seed=0, starts=60):
    """The eight unknowns and the plane, by scipy from rest and from random starts; None where none converges.

    The plane is a ninth unknown. Its equation is the balance of the contact forces, and without contact the middle.
    """
    scale = np.concatenate([UNKNOWN_SCALE[:3], UNKNOWN_SCALE[:3], UNKNOWN_SCALE[3:], [1e-3]])
    weight = np.array([1, 1, 100, 1, 1, 100, 1, 100])
    generator = np.random.default_rng(seed)

    def equations(z):
        unknowns, plane = (z * scale)[:8], z[8] * scale[8]
        xi_l, xi_r = process_positions(left, right, unknowns)
        if xi_l + xi_r <= 0:
            forces = contact_forces(left, right, unknowns, plane)
            last = forces[0] - forces[1]
        else:
            last = (plane - (xi_l - xi_r) / 2) / scale[8]
        eight = residual_of_sides(left, right, unknowns, left_activation, right_activation, plane)
        return np.append(weight * eight, last)

    for start in [np.zeros(9), *generator.uniform(-1, 1, (starts, 9)) * [4, 4, 4, 4, 4, 4, 1, 2, 1]]:
        with np.errstate(all="ignore"):  # bad trial steps overflow the exponentials
            found = root(equations, start, tol=1e-13)
        if np.max(np.abs(found.fun)) < 1e-10:
            return (found.x * scale)[:8], found.x[8] * scale[8]
    return None
