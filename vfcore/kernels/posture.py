"""Root of the posturing equations by continuation from rest.

Equations: posture_equations.py for equal sides, posture_sides.py for different ones.

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
from vfcore.kernels.posture_sides import equilibrium_of_sides

OK, NO_REST, NO_POSTURE = range(3)  # status

TOLERANCE = 1e-12  # of the load scale of each equation
EASY, NEWTON_LIMIT = 4, 7  # at most EASY iterations: the next step may be longer; over NEWTON_LIMIT: rejected
FIRST_STEP, LONGEST_STEP, SHORTEST_STEP = 0.125, 0.25, 1e-9  # fraction of the load
MOVE = (1e-3, 1e-3, 0.1, 0.1, 0.1)  # m, m, rad, strain, strain: largest move of an accepted step
MOVE_OF_SIDES = (1e-3, 1e-3, 0.1, 1e-3, 1e-3, 0.1, 0.1, 0.1)


def continuation(equations, n, rows, count, largest):
    """``solve_linear``, ``relative_size`` and ``continue_leg`` for one system of equations, compiled for its size.

    ``equations(u, activation, passive, larynx, r, jac)`` fills ``r`` (rows,) and the first n columns of ``jac`` (n,
    rows) = ∂r/∂u. Rows from n on must vanish at a root, but steer no step. ``count``: number of activations.
    ``largest`` (n,): largest move of an accepted step.
    """

    @inlined
    def solve_linear(A, b):
        """Overwrite ``b`` (n,) with A⁻¹ b by elimination with row pivoting, and A; return det A (0: singular)."""
        determinant = 1.0
        for k in range(n):
            p = k
            for i in range(k + 1, n):
                if abs(A[i, k]) > abs(A[p, k]):
                    p = i
            if A[p, k] == 0.0:
                return 0.0
            if p != k:
                determinant = -determinant
                for col in range(n):
                    A[k, col], A[p, col] = A[p, col], A[k, col]
                b[k], b[p] = b[p], b[k]
            determinant *= A[k, k]
            for i in range(k + 1, n):
                if A[i, k] == 0.0:  # often so for two sides, which touch only by their processes
                    continue
                f = A[i, k] / A[k, k]
                b[i] -= f * b[k]
                for col in range(k + 1, n):
                    A[i, col] -= f * A[k, col]
        for k in range(n - 1, -1, -1):
            for col in range(k + 1, n):
                b[k] -= A[k, col] * b[col]
            b[k] /= A[k, k]
        return determinant

    @inlined
    def relative_size(r, scale):
        """Largest |r_i|/scale_i; inf if any is not finite."""
        size = 0.0
        for a in range(rows):
            value = abs(r[a]) / scale[a]
            if not value < math.inf:
                return math.inf
            size = max(size, value)
        return size

    @inlined
    def newton(u, activation, passive, larynx, scale, work):
        """Improve ``u`` (n,) in place; return relative residual, iterations, det J there (0: singular or not reached).

        ``work`` (n + 1, rows) is scratch.
        """
        r, jac = work[0], work[1 : n + 1]
        size = math.inf
        for iteration in range(NEWTON_LIMIT + 1):
            equations(u, activation, passive, larynx, r, jac)
            size = relative_size(r, scale)
            determinant = solve_linear(jac, r)  # r becomes J⁻¹ r
            if size <= TOLERANCE or determinant == 0.0 or size == math.inf:
                return size, iteration, determinant
            for a in range(n):
                u[a] -= r[a]
        return size, NEWTON_LIMIT, 0.0

    @inlined
    def continue_leg(u, start, target, passive_start, passive_target, larynx, scale, orientation, loads, point, work):
        """Follow the root from one load to another; return the fraction of the path covered (1: all).

        ``start``, ``target``: activations (count,). ``orientation``: sign that det J must keep.
        ``loads`` (count,), ``point`` (n,) and ``work`` (n + 1, rows) are scratch.
        """
        done, step = 0.0, FIRST_STEP
        while done < 1.0:
            following = min(1.0, done + step)
            for a in range(count):
                loads[a] = start[a] + following * (target[a] - start[a])
            for a in range(n):
                point[a] = u[a]
            passive = passive_start + following * (passive_target - passive_start)
            size, iterations, determinant = newton(point, loads, passive, larynx, scale, work)
            move = 0.0
            for a in range(n):
                move = max(move, abs(point[a] - u[a]) / largest[a])
            if size <= TOLERANCE and determinant * orientation > 0.0 and move <= 1.0:
                done = following
                for a in range(n):
                    u[a] = point[a]
                if iterations <= EASY:
                    step = min(LONGEST_STEP, 2.0 * step)
            else:
                step *= 0.5
                if step < SHORTEST_STEP:
                    break
        return done

    return solve_linear, relative_size, continue_leg


@inlined
def equilibrium_of_equal_sides(u, activation, passive, larynx, r, jac):
    """``equilibrium`` with muscles and joints as one argument."""
    return equilibrium(u, activation, passive, larynx[0], larynx[1], r, jac)


_solve_linear, _relative_size, _continue_leg = continuation(equilibrium_of_equal_sides, 5, 5, 5, MOVE)
_solve_linear_of_sides, _relative_size_of_sides, _continue_leg_of_sides = continuation(
    equilibrium_of_sides, 8, 9, 10, MOVE_OF_SIDES
)


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
        orientation = math.copysign(1.0, _solve_linear(work[1:6], work[0]))
        status[n] = OK
        done = _continue_leg(u, relaxed, relaxed, 0.0, 1.0, (muscles, joints), scale, orientation, loads, point, work)
        if done < 1.0:
            status[n] = NO_REST
        else:
            done = _continue_leg(
                u, relaxed, activations[n], 1.0, 1.0, (muscles, joints), scale, orientation, loads, point, work
            )
            if done < 1.0:
                status[n] = NO_POSTURE
        xi_02, strain = equilibrium(u, activations[n], 1.0, muscles, joints, work[0], work[1:6])
        outcomes[n, 0], outcomes[n, 1] = strain, xi_02
        outcomes[n, 2], outcomes[n, 3] = _relative_size(work[0], scale), done


@jit
def solve_postures_of_sides(
    activations, muscles_l, left, free_l, muscles_r, right, free_r, scale, roots, outcomes, planes, status
):
    """Solve every row of ``activations`` (n, 10), left then right, for a larynx with two different sides, from rest.

    ``free_l``, ``free_r``: the joints with collision_ratio 0. ``scale`` (9,): of the eight equations and of the balance
    of the contact forces. Out: ``roots`` (n, 8); ``outcomes`` (n, 2, 4): for each side as in ``solve_postures``, the
    last two numbers alike; ``planes`` (n,): plane of contact, m to the left of the midline, and without contact the
    middle between the processes; ``status`` (n,).
    """
    relaxed, loads, point = np.zeros(10), np.empty(10), np.empty(8)
    work = np.empty((9, 9))
    larynx = (muscles_l, left, free_l, muscles_r, right, free_r, np.empty((2, 7, 5)))
    for n in range(activations.shape[0]):
        u = roots[n]
        for a in range(8):
            u[a] = 0.0
        equilibrium_of_sides(u, relaxed, 0.0, larynx, work[0], work[1:9])
        orientation = math.copysign(1.0, _solve_linear_of_sides(work[1:9], work[0]))
        status[n] = OK
        done = _continue_leg_of_sides(u, relaxed, relaxed, 0.0, 1.0, larynx, scale, orientation, loads, point, work)
        if done < 1.0:
            status[n] = NO_REST
        else:
            done = _continue_leg_of_sides(
                u, relaxed, activations[n], 1.0, 1.0, larynx, scale, orientation, loads, point, work
            )
            if done < 1.0:
                status[n] = NO_POSTURE
        xi_02_l, strain_l, xi_02_r, strain_r, planes[n] = equilibrium_of_sides(
            u, activations[n], 1.0, larynx, work[0], work[1:9]
        )
        size = _relative_size_of_sides(work[0], scale)
        for side, strain, xi_02 in ((0, strain_l, xi_02_l), (1, strain_r, xi_02_r)):
            outcomes[n, side, 0], outcomes[n, side, 1] = strain, xi_02
            outcomes[n, side, 2], outcomes[n, side, 3] = size, done
