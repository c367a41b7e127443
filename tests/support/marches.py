"""Solvers that a test of the physics can run: each turns start states into the motion of one or two walls."""

from collections.abc import Callable

from tests.support.fold_harness import advance, get_states, product_of, put_states
from tests.support.glottis_twin import GlottisTwin, States
from vfcore.fold.march import TimeMarch

#: (glottis, start with velocities at −dt/2, P_s in Pa, dt in s, steps) → the states at 0, dt, …, steps · dt.
March = Callable[[GlottisTwin, States, float, float, int], list[States]]


def march_of_the_twin(glottis: GlottisTwin, start: States, pressure_pa: float, dt: float, steps: int) -> list[States]:
    record = glottis.march(start, pressure_pa, dt, steps, keep_every=1)
    return [*record.states, record.final]


def march_of_the_product(
    glottis: GlottisTwin, start: States, pressure_pa: float, dt: float, steps: int
) -> list[States]:
    march = TimeMarch(product_of(glottis), dt, pressure_pa)
    put_states(march, start)
    motion = [get_states(march)]
    for _ in range(steps):
        advance(march, 1)
        motion.append(get_states(march))
    return motion


MARCHES: dict[str, March] = {"twin": march_of_the_twin, "product": march_of_the_product}
