"""Statics of the larynx: fold strain and glottal half-angle from muscle activation.

The steady state of Titze & Hunter (2007) as used by Alzamendi et al. (2022). Equations, signs and collision law are in
vfcore/kernels/posture_equations.py, those of two different sides in vfcore/kernels/posture_sides.py, the path from rest
in vfcore/kernels/posture.py. The result depends only on activation and constants: every solve starts from the unloaded
joints.
"""

import math
from collections.abc import Sequence
from functools import lru_cache
from operator import attrgetter

import numpy as np

from vfcore.errors import ParameterError, PostureError
from vfcore.kernels.posture import NO_REST, OK, solve_postures, solve_postures_of_sides
from vfcore.kernels.posture_equations import Joints
from vfcore.larynx.posture.packing import MUSCLE_ORDER, load_scale, load_scale_of_sides, pack
from vfcore.larynx.posture.solution import PostureBatch, PostureSolution
from vfcore.spec.fields import check_number
from vfcore.spec.posture_sets import PosturingConstants, posture_set
from vfcore.spec.simulation import Activation

Sides = tuple[PostureSolution, PostureSolution]  # left, right
SIDES = ("left", "right")
#: Constants of the cricothyroid joint, and those of the equations themselves: one larynx has one value of each.
COMMON_CONSTANTS = (
    "L_0_posture_m",
    "adductor_strain_gain",
    "cos_phi",
    "h_TA_m",
    "w_CT_m",
    *(name for name in Joints._fields if name.startswith(("k_t_", "k_r_"))),
)
_CT, _IA = MUSCLE_ORDER.index("ct"), MUSCLE_ORDER.index("ia")
_Packed = tuple[np.ndarray, Joints, Joints, np.ndarray, Joints, Joints, np.ndarray]


def solve_posture_batch(activations, constants: PosturingConstants) -> PostureBatch:
    """Postures for an array of activations (n, 5), columns TA, CT, LCA, IA, PCA, each in [0, 1].

    Rows are independent of each other. A row without a root holds NaN; no error is raised for it.
    Raises ParameterError for an array of another shape or a value outside [0, 1].
    """
    activations = np.ascontiguousarray(activations, dtype=np.float64)
    if activations.ndim != 2 or activations.shape[1] != 5:
        raise ParameterError("activations", f"shape {activations.shape}", "(n, 5): ta, ct, lca, ia, pca")
    if not ((activations >= 0) & (activations <= 1)).all():
        raise ParameterError("activations", "a value is out of range or not finite", "0 to 1")
    unknowns, outcomes, status = _solved(activations, constants)
    strain, xi_02, residual, reached = outcomes.T
    converged = (status == OK) & (strain > -1)
    strain, xi_02 = np.where(converged, strain, np.nan), np.where(converged, xi_02, np.nan)
    raw = np.arctan(xi_02 / (constants.L_0_posture_m * (1 + strain)))
    return PostureBatch(
        strain=strain,
        glottal_half_angle_rad=np.maximum(raw, 0),
        raw_glottal_half_angle_rad=raw,
        half_gap_m=np.maximum(xi_02, 0),
        unknowns=np.where(converged[:, None], unknowns, np.nan),
        residual=residual,
        converged=converged,
        reached=np.where(status == NO_REST, 0.0, reached),
    )


def _solved(activations: np.ndarray, constants: PosturingConstants) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Output of vfcore.kernels.posture: roots (n, 5), outcomes (n, 4), status (n,)."""
    n = len(activations)
    unknowns, outcomes, status = np.empty((n, 5)), np.empty((n, 4)), np.empty(n, dtype=np.int64)
    solve_postures(activations, *_packed(constants), unknowns, outcomes, status)
    return unknowns, outcomes, status


@lru_cache(maxsize=64)
def _packed(constants: PosturingConstants) -> tuple[np.ndarray, Joints, np.ndarray]:
    """Arrays of a set of constants in the form that the kernel takes."""
    muscles, joints = pack(constants)
    return muscles, joints, load_scale(muscles, joints)


def _packed_last(constants: PosturingConstants) -> tuple[np.ndarray, Joints, np.ndarray]:
    """``_packed`` without hashing every constant when the same set object comes repeatedly, as in a played voice."""
    global _last
    if _last[0] is not constants:
        _last = (constants, _packed(constants))
    return _last[1]


_last: tuple = (None, None)
_levels = attrgetter(*MUSCLE_ORDER)


def solve_posture(
    activation: Activation, constants: PosturingConstants, fold_length_m: float = 0.015
) -> PostureSolution:
    """Posture for one activation; ``fold_length_m`` is the resting length of the vibrating fold (the paper's 15 mm).

    Raises PostureError where no root is connected to rest, ParameterError for a fold length out of range.
    """
    check_number("fold_length_m", fold_length_m, 1e-3, 0.1, "m")
    roots, outcomes, status = np.empty((1, 5)), np.empty((1, 4)), np.empty(1, dtype=np.int64)
    solve_postures(np.array((_levels(activation),), np.float64), *_packed_last(constants), roots, outcomes, status)
    found = _solution(activation, constants, fold_length_m, roots[0].tolist(), outcomes[0].tolist(), int(status[0]))
    if isinstance(found, PostureError):
        raise found
    return found


def solve_each_posture(
    activations: Sequence[Activation], constants: PosturingConstants, fold_length_m: float = 0.015
) -> list[PostureSolution | PostureError]:
    """``solve_posture`` for many activations in one call: for each its posture, or the error that explains why not."""
    check_number("fold_length_m", fold_length_m, 1e-3, 0.1, "m")
    rows = np.array([[getattr(activation, key) for key in MUSCLE_ORDER] for activation in activations], np.float64)
    solved = (array.tolist() for array in _solved(rows.reshape(-1, 5), constants))
    return [
        _solution(activation, constants, fold_length_m, *found)
        for activation, *found in zip(activations, *solved, strict=True)
    ]


def _solution(
    activation: Activation,
    constants: PosturingConstants,
    fold_length_m: float,
    unknowns: list[float],
    outcome: list[float],
    status: int,
) -> PostureSolution | PostureError:
    """Scalars rather than arrays: faster for one posture, and a played voice needs a hundred per second."""
    strain, xi_02, residual, reached = outcome
    if status != OK or not strain > -1:
        what, remedy = _failure(0.0 if status == NO_REST else reached)
        return PostureError(f"no posture for {_described(activation, constants)}: {what}. {remedy}")
    raw = float(np.arctan(xi_02 / (constants.L_0_posture_m * (1 + strain))))
    xi, psi, theta_a, epsilon_t, epsilon_r = unknowns
    return PostureSolution(
        strain=strain,
        glottal_half_angle_rad=max(raw, 0.0),
        raw_glottal_half_angle_rad=raw,
        length_m=fold_length_m * (1 + strain),
        half_gap_m=max(xi_02, 0.0),
        xi_m=xi,
        psi_m=psi,
        theta_a_rad=theta_a,
        epsilon_t=epsilon_t,
        epsilon_r=epsilon_r,
        residual=residual,
        converged=True,
    )


def _described(activation: Activation, constants: PosturingConstants) -> str:
    """Muscles and constants in words, for an error."""
    muscles = ", ".join(f"{key.upper()} {getattr(activation, key):g}" for key in MUSCLE_ORDER)
    changed = " with overridden constants" if constants != posture_set(constants.set_name) else ""
    return f"{muscles} with the posturing set {constants.set_name}{changed}"


def _failure(reached: float) -> tuple[str, str]:
    """What is wrong with a posture that was not reached, and a remedy."""
    if reached == 0:
        return (
            "already the relaxed larynx has no equilibrium that follows from unloaded joints",
            "Take back constants that weaken a joint or stiffen a tissue.",
        )
    if reached == 1:
        return (
            "the equilibrium shortens the fold to less than nothing (strain below -1)",
            "Lower TA, or take back constants that strengthen it or weaken the cricothyroid joint.",
        )
    return (
        f"the equilibrium followed from rest ends at {math.floor(1e4 * reached) / 1e4:.2%} of this activation",
        "Lower the activation, or take back constants that weaken a joint or strengthen a muscle.",
    )


def solve_sides(
    left: Activation,
    right: Activation,
    left_constants: PosturingConstants,
    right_constants: PosturingConstants,
    left_length_m: float = 0.015,
    right_length_m: float = 0.015,
) -> Sides:
    """Posture of a larynx with two different sides, left and right; the lengths are the resting ones of the folds.

    Muscles and cricoarytenoid joint may differ. IA is one muscle with two nerves: both sides have the mean of the two
    IA activations. Where the processes touch, the two half-angles close the glottis at the processes exactly, in the
    middle between them; elsewhere they are the raw ones. Both are signed (see PostureSolution).
    Raises PostureError where no root is connected to rest, ParameterError for a length out of range and where
    COMMON_CONSTANTS differ.
    """
    found = solve_each_sides([(left, right)], left_constants, right_constants, left_length_m, right_length_m)[0]
    if isinstance(found, PostureError):
        raise found
    return found


def solve_each_sides(
    pairs: Sequence[tuple[Activation, Activation]],
    left_constants: PosturingConstants,
    right_constants: PosturingConstants,
    left_length_m: float = 0.015,
    right_length_m: float = 0.015,
) -> list[Sides | PostureError]:
    """``solve_sides`` for many pairs (left, right) in one call: for each its postures, or the error that says why not.

    Raises ParameterError like ``solve_sides``.
    """
    check_number("left_length_m", left_length_m, 1e-3, 0.1, "m")
    check_number("right_length_m", right_length_m, 1e-3, 0.1, "m")
    constants, lengths = (left_constants, right_constants), (left_length_m, right_length_m)
    solved = (array.tolist() for array in _solved_sides(pairs, *constants))
    return [_solution_of_sides(pair, constants, lengths, *found) for pair, *found in zip(pairs, *solved, strict=True)]


def _solved_sides(
    pairs: Sequence[tuple[Activation, Activation]], left: PosturingConstants, right: PosturingConstants
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Output of the kernel: roots (n, 8), outcomes (n, 2, 4), planes (n,), status (n,).

    Equal sides are mirror images of one side, also where the mirrored posture is a root that the eight equations do not
    reach (vfcore/kernels/posture_sides.py).
    """
    packed, alike = _packed_sides_last(left, right)
    n = len(pairs)
    rows = np.array([_levels(one) + _levels(other) for one, other in pairs], np.float64).reshape(n, 10)
    shared = [_IA]
    if alike and left.ct.alpha == left.ct.beta == 0:  # both CT pull only at the joint, where their mean counts
        shared.append(_CT)
    for muscle in shared:
        rows[:, muscle] = rows[:, 5 + muscle] = (rows[:, muscle] + rows[:, 5 + muscle]) / 2
    equal = (rows[:, :5] == rows[:, 5:]).all(axis=1) if alike else np.zeros(n, dtype=bool)
    if not equal.any():
        return _solved_different(rows, packed)
    mirrored, outcome, status = _solved(rows[:, :5], left)
    roots, outcomes = mirrored[:, [0, 1, 2, 0, 1, 2, 3, 4]], np.repeat(outcome[:, None], 2, axis=1)
    planes, different = np.zeros(n), ~equal
    if different.any():
        for array, part in zip(
            (roots, outcomes, planes, status), _solved_different(rows[different], packed), strict=True
        ):
            array[different] = part
    return roots, outcomes, planes, status


def _solved_different(rows: np.ndarray, packed: _Packed) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """``_solved_sides`` for the activations (n, 10) of different sides."""
    n = len(rows)
    roots, outcomes, planes = np.empty((n, 8)), np.empty((n, 2, 4)), np.empty(n)
    status = np.empty(n, dtype=np.int64)
    solve_postures_of_sides(rows, *packed, roots, outcomes, planes, status)
    return roots, outcomes, planes, status


@lru_cache(maxsize=64)
def _packed_sides(left: PosturingConstants, right: PosturingConstants) -> tuple[_Packed, bool]:
    """Arguments of the kernel for two sets of constants, and whether the sets are equal."""
    for name in COMMON_CONSTANTS:
        if left.value(name) != right.value(name):
            raise ParameterError(
                f"right.constants.{name}",
                f"{right.value(name):g} differs from {left.value(name):g} of the left side",
                "one value for both sides, which share the cricothyroid joint",
            )
    muscles_l, joints_l, scale_l = _packed(left)
    muscles_r, joints_r, scale_r = _packed(right)
    free_l, free_r = (joints._replace(collision_ratio=0.0) for joints in (joints_l, joints_r))
    scale = load_scale_of_sides(scale_l, scale_r)
    return (muscles_l, joints_l, free_l, muscles_r, joints_r, free_r, scale), left == right


def _packed_sides_last(left: PosturingConstants, right: PosturingConstants) -> tuple[_Packed, bool]:
    """``_packed_sides`` without hashing every constant when the same objects come repeatedly, as in a played voice."""
    global _last_sides
    if _last_sides[0] is not left or _last_sides[1] is not right:
        _last_sides = (left, right, _packed_sides(left, right))
    return _last_sides[2]


_last_sides: tuple = (None, None, None)


def _solution_of_sides(
    pair: tuple[Activation, Activation],
    constants: tuple[PosturingConstants, PosturingConstants],
    lengths: tuple[float, float],
    unknowns: list[float],
    outcomes: list[list[float]],
    plane: float,
    status: int,
) -> Sides | PostureError:
    strains = [outcome[0] for outcome in outcomes]
    if status != OK or not min(strains) > -1:
        return PostureError(_no_sides(pair, constants, strains, 0.0 if status == NO_REST else outcomes[0][3]))
    xi_02 = [outcome[1] for outcome in outcomes]
    touching = sum(xi_02) <= 0
    middle = (xi_02[0] - xi_02[1]) / 2
    left, right = (
        _side(
            lengths[side],
            unknowns[3 * side : 3 * side + 3] + unknowns[6:],
            outcomes[side],
            constants[side].L_0_posture_m * (1 + strains[side]),
            sign * middle + 0.0 if touching else xi_02[side],  # + 0.0: no negative zero
            sign * plane + 0.0 if touching else None,
        )
        for side, sign in enumerate((1.0, -1.0))
    )
    return left, right


def _side(
    fold_length_m: float,
    unknowns: list[float],
    outcome: list[float],
    stretched_m: float,
    half_gap_m: float,
    plane: float | None,
) -> PostureSolution:
    """One side: ``stretched_m`` is L_0 (1 + ε̄) with the posturing L_0, ``half_gap_m`` its share of the gap."""
    strain, xi_02, residual, _ = outcome
    xi, psi, theta_a, epsilon_t, epsilon_r = unknowns
    return PostureSolution(
        strain=strain,
        glottal_half_angle_rad=math.atan(half_gap_m / stretched_m),
        raw_glottal_half_angle_rad=math.atan(xi_02 / stretched_m),
        length_m=fold_length_m * (1 + strain),
        half_gap_m=half_gap_m,
        xi_m=xi,
        psi_m=psi,
        theta_a_rad=theta_a,
        epsilon_t=epsilon_t,
        epsilon_r=epsilon_r,
        residual=residual,
        converged=True,
        contact_plane_m=plane,
    )


def _no_sides(
    pair: tuple[Activation, Activation],
    constants: tuple[PosturingConstants, PosturingConstants],
    strains: list[float],
    reached: float,
) -> str:
    """The error message for a pair that was not reached; it names the side that fails by itself, if only one does."""
    what, remedy = _failure(reached)
    if reached == 1:
        failing = [name for name, strain in zip(SIDES, strains, strict=True) if not strain > -1]
    else:
        alone = (solve_each_posture([side], own)[0] for side, own in zip(pair, constants, strict=True))
        failing = [name for name, found in zip(SIDES, alone, strict=True) if isinstance(found, PostureError)]
    blame = f" The {failing[0]} side is to blame: with its mirror image it fails too." if len(failing) == 1 else ""
    left, right = (_described(side, own) for side, own in zip(pair, constants, strict=True))
    return f"no posture for left {left}, right {right}: {what}.{blame} {remedy}"
