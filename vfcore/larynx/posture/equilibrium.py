"""Statics of the larynx: fold strain and glottal half-angle from muscle activation.

The steady state of Titze & Hunter (2007) as used by Alzamendi et al. (2022). Equations, signs and collision law are in
vfcore/kernels/posture_equations.py, the path from rest in vfcore/kernels/posture.py. The result depends only on
activation and constants: every solve starts from the unloaded joints.
"""

import math
from collections.abc import Sequence
from functools import lru_cache
from operator import attrgetter

import numpy as np

from vfcore.errors import ParameterError, PostureError
from vfcore.kernels.posture import NO_REST, OK, solve_postures
from vfcore.kernels.posture_equations import Joints
from vfcore.larynx.posture.packing import MUSCLE_ORDER, load_scale, pack
from vfcore.larynx.posture.solution import PostureBatch, PostureSolution
from vfcore.spec.fields import check_number
from vfcore.spec.posture_sets import PosturingConstants, posture_set
from vfcore.spec.simulation import Activation


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
        return PostureError(_no_posture(activation, constants, 0.0 if status == NO_REST else reached))
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


def _no_posture(activation: Activation, constants: PosturingConstants, reached: float) -> str:
    """The error message for a posture that was not reached."""
    muscles = ", ".join(f"{key.upper()} {getattr(activation, key):g}" for key in MUSCLE_ORDER)
    changed = " with overridden constants" if constants != posture_set(constants.set_name) else ""
    if reached == 0:
        what = "already the relaxed larynx has no equilibrium that follows from unloaded joints"
        remedy = "Take back constants that weaken a joint or stiffen a tissue."
    elif reached == 1:
        what = "the equilibrium shortens the fold to less than nothing (strain below -1)"
        remedy = "Lower TA, or take back constants that strengthen it or weaken the cricothyroid joint."
    else:
        what = f"the equilibrium followed from rest ends at {math.floor(1e4 * reached) / 1e4:.2%} of this activation"
        remedy = "Lower the activation, or take back constants that weaken a joint or strengthen a muscle."
    return f"no posture for {muscles} with the posturing set {constants.set_name}{changed}: {what}. {remedy}"
