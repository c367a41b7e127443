"""The longest stable time step of a fold, computed before the run.

A mode of angular frequency ω and damping rate c obeys, under the step of vfcore/kernels/fold.py,

    z (z − 1)² + (z − 1)(3/2 a z − a/2) + s (z² + (z − 1)²/12) = 0,    s = ω² dt²,  a = c dt

(velocity on half steps, dampers at the extrapolated velocity, Störmer's displacement). As dt grows, the first root to
reach the unit circle is the alternating mode z = −1, at s/3 + a = 1. So the bound is

    dt < 2/(c + √(c² + 4/3 ω²))

The largest ω² and c on the grid are bounded by those of the membrane alone or of the beam alone, whichever allows the
shorter step, plus those of the coupling between them; all springs and dampers count as engaged. The tension, bending
and end moments of the beam are implicit and set no limit; its foundation limits the step slightly less than the bound
says. The air is not included. Derivation: docs/model/numerics.md, "Stability".
"""

import math

from vfcore.errors import StabilityError
from vfcore.fold.assemble import Fold
from vfcore.kernels.tissue import longest_step
from vfcore.spec.simulation import DEFAULT_STEP_S, Run

#: Fraction of the bound that is used: margin for rounding and for the air, which the linear bound does not include.
SAFETY = 0.95


def longest_stable_step_s(fold: Fold) -> float:
    """SAFETY times the step, s, at which a mode of the linear system, with contact engaged, would grow."""
    c, stiffest = fold.coefficients, float(fold.K_coup_pa_m.max())
    return SAFETY * longest_step(
        fold.rotation,
        fold.dx,
        fold.dy,
        c.membrane_tension_n_m,
        c.membrane_shear_n_m,
        c.membrane_shear_viscosity_n_s_m,
        c.membrane_density_kg_m2,
        c.rotation_inertia_kg_m,
        c.thickness_m,
        c.beam_density_kg_m,
        stiffest,
        fold.constants,
    )


def time_step_s(run: Run, fold: Fold) -> float:
    """The time step of a run, s: the requested one, or the longest stable DEFAULT_STEP_S/k.

    Raises StabilityError if the requested step is too long for the grid.
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
    """``value`` rounded down to three digits: the step named in a refusal must itself be accepted."""
    digit = 10.0 ** (math.floor(math.log10(value)) - 2)
    return math.floor(value / digit) * digit
