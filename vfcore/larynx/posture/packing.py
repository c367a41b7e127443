"""Posturing constants as the arrays and floats that the kernel takes, and the scale of its residuals."""

from dataclasses import fields
from operator import attrgetter

import numpy as np

from vfcore.kernels.posture_equations import (
    ALPHA,
    BETA,
    CT,
    GAMMA,
    LIG,
    MUC,
    SECTION,
    SIGMA_0,
    SIGMA_MAX,
    TA,
    Joints,
)
from vfcore.spec.muscles import Muscle
from vfcore.spec.posture_sets import PosturingConstants

MUSCLE_ORDER = ("ta", "ct", "lca", "ia", "pca")  # of an activation vector
SMALLEST_FORCE_SCALE_N = 1e-3
SMALLEST_MOMENT_SCALE_N_M = 1e-5

_rows = attrgetter(*MUSCLE_ORDER, "lig", "muc")
_columns = attrgetter(*(spec.name for spec in fields(Muscle)))
_joints = attrgetter(*Joints._fields)


def pack(constants: PosturingConstants) -> tuple[np.ndarray, Joints]:
    """Rows of muscles and passive tissues, (7, 13) in the kernel's order, and the joint constants."""
    return np.array([_columns(row) for row in _rows(constants)]), Joints(*_joints(constants))


def load_scale(muscles: np.ndarray, joints: Joints) -> np.ndarray:
    """Scale of the five residuals, (5,): N, N, N·m, N, N·m.

    The load that all muscles together could put on that equation, Σ |lever_i| A_i (σ_max,i + σ_0,i), with levers
    α_i; β_i; γ_i; cos φ for CT and 1 for TA, ligament and mucosa; w for CT and h for those. At least 1 mN or 10 µN·m.
    """
    peak = muscles[:, SECTION] * (muscles[:, SIGMA_MAX] + muscles[:, SIGMA_0])
    tension = peak[TA] + peak[LIG] + peak[MUC]
    levers = np.abs(muscles[:, [ALPHA, BETA, GAMMA]])
    levers[CT, 2] = 0.0
    load_x, load_y, moment = peak @ levers
    return np.array(
        [
            max(SMALLEST_FORCE_SCALE_N, load_x),
            max(SMALLEST_FORCE_SCALE_N, load_y),
            max(SMALLEST_MOMENT_SCALE_N_M, moment),
            max(SMALLEST_FORCE_SCALE_N, joints.cos_phi * peak[CT] + tension),
            max(SMALLEST_MOMENT_SCALE_N_M, joints.w_CT_m * peak[CT] + joints.h_TA_m * tension),
        ]
    )


def load_scale_of_sides(left: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Scale of the residuals of two sides, (9,), from the ``load_scale`` of each.

    The three equations of the left arytenoid, the three of the right, the two of the cricothyroid joint (mean of both
    sides), and the balance of the lateral contact forces (mean of both sides).
    """
    mean = (left + right) / 2
    return np.concatenate([left[:3], right[:3], mean[3:], mean[:1]])
