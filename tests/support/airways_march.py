"""A small kernel that marches airways as the step of the fold does: a closure over constants, found in the cache."""

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from vfcore.airways.coupled import Airways
from vfcore.fold.form import LANES
from vfcore.kernels import airways, airways_many
from vfcore.kernels.jit import inlined, jit
from vfcore.kernels.simd import load, store

advance_airways, advance_airways_many = airways.advance_airways, airways_many.advance_airways_many
FLOW, INLET, OUTLET, DROP = airways_many.FLOW, airways_many.INLET, airways_many.OUTLET, airways_many.DROP


@jit
def march_alone(air, P_s, conductance, viscous, out):
    """Advance one fold's airways by ``P_s.size`` steps; ``out`` (steps·4,): flow, inlet, outlet, drop of each."""
    for n in range(P_s.size):
        advance_airways(air, P_s[n], conductance[n], viscous[n])
        out[4 * n], out[4 * n + 1], out[4 * n + 2], out[4 * n + 3] = air[FLOW], air[INLET], air[OUTLET], air[DROP]


@lru_cache
def march_kernel(precision: str) -> Callable[..., None]:
    """The compiled loop ``march(air, P_s, conductance, viscous, out)`` for W folds; arrays as above with W of each."""
    W = LANES[precision]

    @inlined
    def march(air, P_s, conductance, viscous, out):
        for n in range(P_s.size // W):
            at = n * W
            advance_airways_many(air, load(P_s, at, W), load(conductance, at, W), load(viscous, at, W))
            store(out, 4 * at, load(air, FLOW * W, W))
            store(out, 4 * at + W, load(air, INLET * W, W))
            store(out, 4 * at + 2 * W, load(air, OUTLET * W, W))
            store(out, 4 * at + 3 * W, load(air, DROP * W, W))

    return march


def alone(ways: Airways, P_s: np.ndarray, conductance: np.ndarray, viscous: np.ndarray) -> np.ndarray:
    """Flow, inlet, outlet and drop of one fold at every step, (steps, 4); inputs (steps,)."""
    out = np.empty(4 * len(P_s))
    P_s, conductance, viscous = (np.ascontiguousarray(one) for one in (P_s, conductance, viscous))
    march_alone(ways.new_buffer(P_s[0]), P_s, conductance, viscous, out)
    return out.reshape(-1, 4)


def together(
    ways: list[Airways], P_s: np.ndarray, conductance: np.ndarray, viscous: np.ndarray, precision: str = "float64"
) -> np.ndarray:
    """The same for LANES[precision] folds side by side, (steps, 4, folds); inputs (steps, folds)."""
    air = Airways.new_buffers(list(zip(ways, P_s[0], strict=True)), precision)
    out = np.empty(4 * P_s.size, precision)
    march_kernel(precision)(air, *(np.ravel(one).astype(precision) for one in (P_s, conductance, viscous)), out)
    return out.reshape(len(P_s), 4, -1)
