"""Where a node of the membrane is after a step: Störmer's formula of third order.

With velocities on half steps, v^{n+½} = v^{n−½} + δ^n, δ^n = dt a^n, the plain step w^{n+1} = w^n + dt v^{n+½} takes
the second difference of w for dt² a and runs a mode ω too fast by h²/24, h = ω dt. Störmer's formula takes in the next
term, the second difference of a:

    w^{n+1} − 2 w^n + w^{n−1} = dt² (a^n + (a^n − 2 a^{n−1} + a^{n−2})/12)

which is summed once by

    w^{n+1} = w^n + dt (v^{n+½} + (δ^n − δ^{n−1})/12)

Then h²/24 becomes 0.023 h⁴, and a mode without damper loses h³/24 of its amplitude per radian (docs/model/numerics.md,
"Accuracy"). The increment before is read from the two velocities that are kept, δ^{n−1} = 2 (v* − v^{n−½}):

    v^{n+½} + (δ^n − δ^{n−1})/12 = (7 v^{n−½} − v*)/6 + 13/12 δ^n
"""

from vfcore.kernels.jit import jit


@jit
def displaced(w, v, v_star, inverse, force, dt):
    """w^{n+1} from w^n, v^{n−½} and v* at n; δ^n = ``inverse`` · ``force``, ``inverse`` being dt over the mass."""
    return w + 7 / 6 * dt * v - 1 / 6 * dt * v_star + 13 / 12 * dt * inverse * force
