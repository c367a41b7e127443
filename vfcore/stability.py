"""How long a step may be, known before the first one is taken.

One mode with frequency ω and damping rate c under the step of vfcore/kernels/fold.py obeys

    z (z − 1)² + (z − 1)(3/2 a z − a/2) + s z² = 0,    s = ω² dt²,  a = c dt

(velocity on half steps, dampers at the extrapolated velocity). As dt grows the first root to
reach the unit circle is the one at z = −1, where s + 4a = 4: the alternating mode. Bounds on
ω² and c over the whole grid come from the largest eigenvalue of each stencil, all springs and
dampers taken as engaged. The beam's own stiffness is implicit and sets no limit.
"""

import math

from vfcore.assemble import Fold
from vfcore.errors import StabilityError
from vfcore.params import DEFAULT_STEP_S, Run

#: Fraction of the bound that is used: the bound is for one mode, the coupled system is slightly stiffer.
SAFETY = 0.95


def longest_stable_step_s(fold: Fold) -> float:
    """The longest step that keeps every mode of the linear system, in contact, from growing; s."""
    c, k = fold.coefficients, fold.constants
    rho = c.membrane_density_kg_m2
    K_coup = float(fold.K_coup_pa_m.max())
    shear = 4.0 / fold.dy**2
    omega2 = (4.0 * c.membrane_tension_n_m / fold.dx**2 + shear * c.membrane_shear_n_m + K_coup + k.K_col_pa_m) / rho
    rate = (shear * c.membrane_shear_viscosity_n_s_m + k.C_coup_pa_s_m + k.C_col_pa_s_m) / rho
    rate += k.C_coup_pa_s_m * c.thickness_m / c.beam_density_kg_m
    omega2 += K_coup * c.thickness_m / c.beam_density_kg_m
    rate_foundation = (k.C_foun_pa_s + k.C_coup_pa_s_m * c.thickness_m) / c.beam_density_kg_m
    rate = max(rate, rate_foundation)
    if fold.rotation:
        omega2 += k.G_m_pa / c.rotation_inertia_kg_m
        rate += k.eta_m_pa_s / c.rotation_inertia_kg_m
    # s + 4a = 4 with s = ω² dt², a = c dt
    return SAFETY * 2.0 * (math.sqrt(rate**2 * 4.0 + omega2 * 4.0) - 2.0 * rate) / (2.0 * omega2)


def time_step_s(run: Run, fold: Fold) -> float:
    """The step in force: the one asked for, or the longest stable DEFAULT_STEP_S/k.

    Raises StabilityError when the step asked for is too long for the grid.
    """
    limit = longest_stable_step_s(fold)
    if run.time_step_s is None:
        return DEFAULT_STEP_S / max(1, math.ceil(DEFAULT_STEP_S / limit))
    if run.time_step_s > limit:
        raise StabilityError(
            "run.time_step_s",
            f"{run.time_step_s:.4g} s would grow without bound on the {fold.nx}×{fold.ny} grid at this posture",
            f"up to {limit:.3g} s here; null lets Vocalis choose; a coarser grid in y allows a longer step",
        )
    return float(run.time_step_s)
