"""The longest stable time step of a glottis, computed before the run.

A mode of angular frequency ω and damping rate c obeys, under the step of vfcore/fold/step.py,

    z (z − 1)² + (z − 1)(3/2 a z − a/2) + s (z² + (z − 1)²/12) = 0,    s = ω² dt²,  a = c dt

(velocity on half steps, dampers at the extrapolated velocity, Störmer's displacement). As dt grows, the first root to
reach the unit circle is the alternating mode z = −1, at s/3 + a = 1. So the bound is

    dt < 2/(c + √(c² + 4/3 ω²))

The largest ω² and c on the grid are bounded by those of the membrane alone or of the beam alone, whichever allows the
shorter step, plus those of the coupling between them; all springs and dampers count as engaged, each at its largest
value over the surface and at the smallest mass. Each term adds its share:

    tension    4 T/dx² over ρ_s; with finite stretch T at the largest swing (tension.SWING_PA), and on the beam what the
               stretch adds, 4 N'/dx² over ρ_l
    shear      4 G̃/dy² and 4 η̃/dy² over ρ_s; rotation: G_m and η_m over J_m too
    contact    K_col and C_col over ρ_s
    coupling   K_coup and C_coup over the reduced mass, 1/ρ_s + b/ρ_l;  foundation: K_foun and C_foun over ρ_l

The prestrain's tension, the bending and the end moments of the beam are implicit and set no limit; its foundation
limits the step slightly less than the bound says. The air is not included. Of two walls the tighter bound holds.
Derivation: docs/model/numerics.md, "Stability".
"""

import math

from vfcore.errors import StabilityError
from vfcore.fold.assemble import Fold, Glottis
from vfcore.fold.terms import WALL_NUMBERS, coupling, place_of, shear, tension
from vfcore.kernels.jit import formula, jit
from vfcore.spec.simulation import DEFAULT_STEP_S, Run

#: Fraction of the bound that is used: margin for rounding and for the air, which the linear bound does not include.
SAFETY = 0.95
#: How often the step is halved for a march that diverges.
HALVINGS = 2
bound_tension, bound_shear, bound_coupling = tension.bound, shear.bound, coupling.bound
_TENSION, _SHEAR, _COUPLING = (place_of(term).start for term in (tension, shear, coupling))
_INV_RHO_L = WALL_NUMBERS.index("inv_beam_density")


@jit
def longest_step(rotation, finite, length, thickness, fields, numbers):
    """The time step at which the first mode of a wall would grow, s. Arguments as in vfcore.fold.assemble.Fold."""
    ny, nx = fields.shape[1:]
    lightest, largest = math.inf, [0.0] * 9
    for j in range(ny):
        for i in range(nx):
            lightest = min(lightest, fields[1, j, i])
            for k in range(2, 9):
                largest[k] = max(largest[k], fields[k, j, i])
    inv_rho_s, inv_rho_l = 1.0 / lightest, numbers[_INV_RHO_L]
    K_T, K_N = bound_tension(finite, numbers[_TENSION:_SHEAR], largest[2], length, length / (nx - 1))
    K_G, C_G, turning_omega2, turning_rate = bound_shear(rotation, numbers[_SHEAR:_COUPLING], largest[3], largest[4])
    omega2, rate = bound_coupling(largest[5], largest[6], inv_rho_s, inv_rho_l, thickness)
    K_col, C_col, K_foun, C_foun = largest[7], largest[8], numbers[_COUPLING + 1], numbers[_COUPLING + 2]
    return min(
        critical_step(
            (K_T + K_G + K_col) * inv_rho_s + turning_omega2 + omega2, (C_G + C_col) * inv_rho_s + turning_rate + rate
        ),
        critical_step((K_foun + K_N) * inv_rho_l + omega2, C_foun * inv_rho_l + rate),
    )


@formula
def critical_step(omega2, rate):
    """The step at which s/3 + a = 1, s; infinite without spring and damper."""
    weight = rate + math.sqrt(rate**2 + 4.0 / 3.0 * omega2)
    return 2.0 / weight if weight > 0.0 else math.inf


def longest_stable_step_s(glottis: Glottis) -> float:
    """SAFETY times the step, s, at which a mode of the linear system, with contact engaged, would grow."""
    return SAFETY * min(_longest(wall) for wall in glottis.walls)


def _longest(wall: Fold) -> float:
    c = wall.coefficients
    return longest_step(wall.rotation, wall.finite, c.length_m, c.thickness_m, wall.fields, wall.numbers)


def time_step_s(run: Run, glottis: Glottis) -> float:
    """The time step of a run, s: the requested one, or the longest stable DEFAULT_STEP_S/k.

    Raises StabilityError if the requested step is too long for the grid.
    """
    limit = longest_stable_step_s(glottis)
    if run.time_step_s is None:
        return DEFAULT_STEP_S / max(1, math.ceil(DEFAULT_STEP_S / limit))
    if run.time_step_s > limit:
        raise StabilityError(
            "run.time_step_s",
            f"{run.time_step_s:.4g} s would grow without bound on the {glottis.nx}×{glottis.ny} grid at this posture",
            f"up to {_rounded_down(limit):.3g} s here; null lets Vocalis choose; "
            "a coarser grid in y allows a longer step",
        )
    return float(run.time_step_s)


def steps_to_try(run: Run, glottis: Glottis) -> list[float]:
    """``time_step_s``, and shorter ones for a march that diverges, s.

    The bound does not include the air, and with finite stretch it holds up to a largest swing (terms/tension.py). A
    voice beyond that may diverge at the chosen step although it has a solution, so it is marched again at half the
    step, HALVINGS times at most. A requested step is tried alone.
    """
    first = time_step_s(run, glottis)
    halvings = HALVINGS if run.time_step_s is None else 0
    return [first / 2**k for k in range(halvings + 1)]


def _rounded_down(value: float) -> float:
    """``value`` rounded down to three digits: the step named in a refusal must itself be accepted."""
    digit = 10.0 ** (math.floor(math.log10(value)) - 2)
    return math.floor(value / digit) * digit
