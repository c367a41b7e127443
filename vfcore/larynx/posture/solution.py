"""Results of the posturing statics: one posture, or arrays of many."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np


@dataclass(frozen=True, slots=True)
class PostureSolution:
    """One posture of one fold, SI.

    strain: nominal fold strain ε̄. length_m: fold length L_0 (1 + ε̄) with the vibrating fold's L_0.
    glottal_half_angle_rad: atan(ξ_02/(L_0 (1 + ε̄))) with the posturing L_0, clipped at 0 (θ_g);
    raw_glottal_half_angle_rad: the same before clipping; the collision spring yields a little, so it is
    slightly negative at full adduction. half_gap_m: distance of the vocal process from the medial plane,
    ξ_02 clipped at 0: half the gap between the processes. xi_m, psi_m, theta_a_rad: lateral and anterior translation
    and inward rotation of the arytenoid. epsilon_t, epsilon_r: strain by cricothyroid translation, rotation.
    residual: largest of the residuals over its scale (packing.load_scale), at most 1e-12 when converged.

    A side of a larynx with two different sides (equilibrium.solve_sides): the distances and angles at the vocal process
    are signed, from the midline towards this side, so one is negative for a side that crosses the midline. Where the
    processes touch, glottal_half_angle_rad and half_gap_m are those of a process in the middle between both, and
    contact_plane_m is the plane in which the contact forces balance. Otherwise contact_plane_m is None.
    """

    strain: float
    glottal_half_angle_rad: float
    raw_glottal_half_angle_rad: float
    length_m: float
    half_gap_m: float
    xi_m: float
    psi_m: float
    theta_a_rad: float
    epsilon_t: float
    epsilon_r: float
    residual: float
    converged: bool
    contact_plane_m: float | None = None


class PostureBatch(NamedTuple):
    """Arrays over n activations. Rows without convergence hold NaN, and the fraction of the path in ``reached``."""

    strain: np.ndarray  # (n,)
    glottal_half_angle_rad: np.ndarray  # (n,), clipped at 0
    raw_glottal_half_angle_rad: np.ndarray  # (n,)
    half_gap_m: np.ndarray  # (n,), clipped at 0
    unknowns: np.ndarray  # (n, 5): ξ m, ψ m, θ_a rad, ε_t, ε_r
    residual: np.ndarray  # (n,), relative to the load scale
    converged: np.ndarray  # (n,) bool
    reached: np.ndarray  # (n,), from 0 (rest) to 1 (the requested activation)
