"""Displacement of a membrane node after a step: Störmer's formula of third order (docs/model/numerics.md).

With velocities on half steps, v^{n+½} = v^{n−½} + δ^n, δ^n = dt a^n, the plain step w^{n+1} = w^n + dt v^{n+½} sets
the second difference of w to dt² a. A mode of angular frequency ω is then too fast by h²/24, h = ω dt. Störmer's
formula includes the next term, the second difference of a:

    w^{n+1} − 2 w^n + w^{n−1} = dt² (a^n + (a^n − 2 a^{n−1} + a^{n−2})/12)

Summed once, that is

    w^{n+1} = w^n + dt (v^{n+½} + (δ^n − δ^{n−1})/12)

The frequency error h²/24 becomes 0.023 h⁴, and an undamped mode loses h³/24 of its amplitude per radian. The previous
increment follows from the two stored velocities, δ^{n−1} = 2 (v* − v^{n−½}):

    v^{n+½} + (δ^n − δ^{n−1})/12 = (7 v^{n−½} − v*)/6 + 13/12 δ^n
"""

from vfcore.kernels.jit import jit


@jit
def displaced(w, v, v_star, inverse, force, dt):
    """w^{n+1} from w^n, v^{n−½} and v* at n; δ^n = ``inverse`` · ``force``, ``inverse`` being dt over the mass."""
    return w + 7 / 6 * dt * v - 1 / 6 * dt * v_star + 13 / 12 * dt * inverse * force
