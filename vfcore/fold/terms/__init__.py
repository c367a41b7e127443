"""The terms of the fold's equations: one file per force.

Each file has the law (equation, index form, units, source), the force as compiled functions that are inlined into the
step (fold/step.py), the names and values of the numbers that the step needs for it, its share in the stability bound
(``bound``), in the static solve (``static``) and in the energy (``energy``). The constants they read are declared in
fold/constants.py.
"""

from types import ModuleType

import numpy as np

from vfcore.fold.terms import air, contact, coupling, shear, tension

#: Numbers of the glottis as a whole.
GLOTTIS_NUMBERS = ("dt", "dy", *air.NUMBERS, *contact.NUMBERS)
#: The terms of a wall, in the order of their numbers.
WALL_TERMS = (tension, shear, coupling)
#: Numbers of each wall: spacing, 1/ρ_l, and those of its terms.
WALL_NUMBERS = ("dy", "inv_beam_density", *(name for term in WALL_TERMS for name in term.NUMBERS))


def place_of(term: ModuleType) -> slice:
    """Where the numbers of a term are among WALL_NUMBERS."""
    begin = WALL_NUMBERS.index(term.NUMBERS[0])
    return slice(begin, begin + len(term.NUMBERS))


def of_term(numbers: np.ndarray, term: ModuleType) -> np.ndarray:
    """The numbers of a term, a view of those of a wall."""
    return numbers[place_of(term)]
