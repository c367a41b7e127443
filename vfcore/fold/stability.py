"""How long a step may be, known before the first one is taken.

One mode with frequency ω and damping rate c under the step of vfcore/kernels/fold.py obeys

    z (z − 1)² + (z − 1)(3/2 a z − a/2) + s (z² + (z − 1)²/12) = 0,    s = ω² dt²,  a = c dt

(velocity on half steps, dampers at the extrapolated velocity, Störmer's displacement). As dt grows
the first root to reach the unit circle is the one at z = −1, where s/3 + a = 1: the alternating
mode. The largest ω² and c on the grid are bounded by those of the membrane alone or the beam alone,
whichever allows less, plus those of the coupling between them; all springs and dampers are taken as
engaged. The beam's tension, bending and end moments are implicit and set no limit; its foundation
does, a little less than the bound says.
"""

import math

from vfcore.errors import StabilityError
from vfcore.fold.assemble import Fold
from vfcore.kernels.tissue import longest_step
from vfcore.spec.simulation import DEFAULT_STEP_S, Run

#: Fraction of the bound that is used: room for rounding and for the air, which the linear bound leaves out.
SAFETY = 0.95


def longest_stable_step_s(fold: Fold) -> float:
    """The longest step that keeps every mode of the linear system, in contact, from growing; s."""
    c, stiffest = fold.coefficients, float(fold.K_coup_pa_m.max())
    return SAFETY * longest_step(
        fold.rotation, fold.dx, fold.dy, c.membrane_tension_n_m, c.membrane_shear_n_m,
        c.membrane_shear_viscosity_n_s_m, c.membrane_density_kg_m2, c.rotation_inertia_kg_m, c.thickness_m,
        c.beam_density_kg_m, stiffest, fold.constants,
    )  # fmt: skip


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
            f"up to {_rounded_down(limit):.3g} s here; null lets Vocalis choose; "
            "a coarser grid in y allows a longer step",
        )
    return float(run.time_step_s)


def _rounded_down(value: float) -> float:
    """``value`` to three digits, never above it: the step a refusal names must itself be accepted."""
    digit = 10.0 ** (math.floor(math.log10(value)) - 2)
    return math.floor(value / digit) * digit
