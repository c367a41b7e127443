"""Root of the posturing equations by continuation from rest. Equations: posture_equations.py.

    r(u; s) = 0 with the loads s·(load), s from 0 to 1;   Newton: u ← u − J(u)⁻¹ r(u),   |r_i| ≤ 1e-12 scale_i

The loads enter linearly, so a Newton step from the last root is also the tangent predictor. First the passive loads are
raised from zero (where u = 0 is exact) to rest, then all activations at once along the straight line from rest. A step
is accepted only if Newton converges in few iterations, the posture moves little, and det J keeps the sign that it has
without load. So the path cannot jump to another branch unnoticed.

At a fold of the path (det J = 0) continuation in the activation ends: the larynx of the model would snap to a distant
posture, and its dynamics decide which. This counts as a failure, reported with its position. With the published sets no
fold and no second root was found in [0, 1]^5, neither on the paths to 10,000 random activations each nor from random
starts; this is an observation, not a proof. Overridden constants can fold the path.

J jumps at the kinks of |d_t| and |d_r|, at collision, at ε_1 and at the end of the active stress. Plain Newton steps
cross these kinks: while det J keeps its sign, the root of the linear equations on one side lies on the other side, and
the next step from there converges. A line search on the residual would stall at a kink, so the load steps are short
instead.
"""

import math

import numpy as np

from vfcore.kernels.jit import inlined, jit
from vfcore.kernels.posture_equations import equilibrium

OK, NO_REST, NO_POSTURE = range(3)  # status

TOLERANCE = 1e-12  # of the load scale of each equation
EASY, NEWTON_LIMIT = 4, 7  # at most EASY iterations: the next step may be longer; over NEWTON_LIMIT: rejected
FIRST_STEP, LONGEST_STEP, SHORTEST_STEP = 0.125, 0.25, 1e-9  # fraction of the load
MOVE = (1e-3, 1e-3, 0.1, 0.1, 0.1)  # m, m, rad, strain, strain: largest move of an accepted step


@inlined
def solve_linear(A, b):
    """Overwrite ``b`` (5,) with A⁻¹ b by elimination with row pivoting, and A; return det A (0: singular)."""
    determinant = 1.0
    for k in range(5):
        p = k
        for i in range(k + 1, 5):
            if abs(A[i, k]) > abs(A[p, k]):
                p = i
        if A[p, k] == 0.0:
            return 0.0
        if p != k:
            determinant = -determinant
            for col in range(5):
                A[k, col], A[p, col] = A[p, col], A[k, col]
            b[k], b[p] = b[p], b[k]
        determinant *= A[k, k]
        for i in range(k + 1, 5):
            f = A[i, k] / A[k, k]
            b[i] -= f * b[k]
            for col in range(k + 1, 5):
                A[i, col] -= f * A[k, col]
    for k in range(4, -1, -1):
        for col in range(k + 1, 5):
            b[k] -= A[k, col] * b[col]
        b[k] /= A[k, k]
    return determinant


@inlined
def relative_size(r, scale):
    """Largest |r_i|/scale_i; inf if any is not finite."""
    size = 0.0
    for a in range(5):
        value = abs(r[a]) / scale[a]
        if not value < math.inf:
            return math.inf
        size = max(size, value)
    return size


@inlined
def newton(u, activation, passive, muscles, joints, scale, work):
    """Improve ``u`` (5,) in place; return relative residual, iterations and det J there (0: singular or not reached).

    ``work`` (6, 5) is scratch.
    """
    r, jac = work[0], work[1:6]
    size = math.inf
    for iteration in range(NEWTON_LIMIT + 1):
        equilibrium(u, activation, passive, muscles, joints, r, jac)
        size = relative_size(r, scale)
        determinant = solve_linear(jac, r)  # r becomes J⁻¹ r
        if size <= TOLERANCE or determinant == 0.0 or size == math.inf:
            return size, iteration, determinant
        for a in range(5):
            u[a] -= r[a]
    return size, NEWTON_LIMIT, 0.0


@inlined
def continue_leg(
    u, start, target, passive_start, passive_target, muscles, joints, scale, orientation, loads, point, work
):
    """Follow the root from one load to another; return the fraction of the path covered (1: all).

    ``start``, ``target``: activations (5,). ``orientation``: sign that det J must keep.
    ``loads``, ``point`` (5,) and ``work`` (6, 5) are scratch.
    """
    done, step = 0.0, FIRST_STEP
    while done < 1.0:
        following = min(1.0, done + step)
        for a in range(5):
            loads[a] = start[a] + following * (target[a] - start[a])
            point[a] = u[a]
        passive = passive_start + following * (passive_target - passive_start)
        size, iterations, determinant = newton(point, loads, passive, muscles, joints, scale, work)
        move = 0.0
        for a in range(5):
            move = max(move, abs(point[a] - u[a]) / MOVE[a])
        if size <= TOLERANCE and determinant * orientation > 0.0 and move <= 1.0:
            done = following
            for a in range(5):
                u[a] = point[a]
            if iterations <= EASY:
                step = min(LONGEST_STEP, 2.0 * step)
        else:
            step *= 0.5
            if step < SHORTEST_STEP:
                break
    return done


@jit
def solve_postures(activations, muscles, joints, scale, roots, outcomes, status):
    """Solve every row of ``activations`` (n, 5), order TA, CT, LCA, IA, PCA, each from rest.

    Out: ``roots`` (n, 5); ``outcomes`` (n, 4): fold strain, ξ_02 (m, signed), relative residual, fraction of
    the path covered; ``status`` (n,). If the status is not OK, the root is the last one reached.
    """
    relaxed, loads, point = np.zeros(5), np.empty(5), np.empty(5)
    work = np.empty((6, 5))
    for n in range(activations.shape[0]):
        u = roots[n]
        for a in range(5):
            u[a] = 0.0
        equilibrium(u, relaxed, 0.0, muscles, joints, work[0], work[1:6])
        orientation = math.copysign(1.0, solve_linear(work[1:6], work[0]))
        status[n] = OK
        done = continue_leg(u, relaxed, relaxed, 0.0, 1.0, muscles, joints, scale, orientation, loads, point, work)
        if done < 1.0:
            status[n] = NO_REST
        else:
            done = continue_leg(
                u, relaxed, activations[n], 1.0, 1.0, muscles, joints, scale, orientation, loads, point, work
            )
            if done < 1.0:
                status[n] = NO_POSTURE
        xi_02, strain = equilibrium(u, activations[n], 1.0, muscles, joints, work[0], work[1:6])
        outcomes[n, 0], outcomes[n, 1] = strain, xi_02
        outcomes[n, 2], outcomes[n, 3] = relative_size(work[0], scale), done
