"""The terms of the fold's equations: one file per force.

Each file has the force as compiled functions that are inlined into the step (fold/step.py), and the names of the
numbers that the step needs for it. Its share in the stability bound, in the static solve and in the energy are in
stability.py, equilibrium.py and energy.py of vfcore/fold, one function per term.
"""

from vfcore.fold.terms import air, contact, coupling, shear, tension

#: Numbers of the glottis as a whole.
GLOTTIS_NUMBERS = ("dt", "dy", *air.NUMBERS, *contact.NUMBERS)
#: Numbers of each wall: spacing, 1/ρ_l, and those of its terms.
WALL_NUMBERS = ("dy", "inv_beam_density", *tension.NUMBERS, *shear.NUMBERS, *coupling.NUMBERS)
