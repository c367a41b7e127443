"""Slow, obvious twin of the dynamics of two folds that are mirror images of each other.

The tissue is that of tests/support/wall_twin.py, the air that of flow_twin.py, contact and time steps those of
glottis_twin.py with one wall. Here states are those of one fold, not tuples.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy.linalg import eigh

from tests.support.flow_twin import AirTwin, Flow
from tests.support.glottis_twin import GlottisTwin
from tests.support.wall_twin import State, WallTwin

__all__ = ["FoldTwin", "Record", "State"]


class Record(NamedTuple):
    """Time series of a run; sample k is the state at k·dt, before the step that leaves it."""

    t: np.ndarray  # s, (steps,)
    A_g_min: np.ndarray  # m², (steps,)
    Q_g: np.ndarray  # m³/s, (steps,)
    p_col_max: np.ndarray  # Pa, (steps,); 0 where nothing touches, may be negative at separation
    p_col_max_at: np.ndarray  # (steps, 2), grid node (i, j); (-1, -1) where nothing touches
    states: list[State]  # every ``keep_every``-th state
    final: State


@dataclass(frozen=True, eq=False)
class FoldTwin(WallTwin):
    """One fold, facing its mirror image."""

    air_law: type[AirTwin] = AirTwin

    @cached_property
    def glottis(self) -> GlottisTwin:
        return GlottisTwin((self,), self.air_law)

    def contact_pressure(self, w_m, v_m):
        """p_col over (nx, ny), Pa, including the two fixed slices."""
        return self.glottis.contact_pressure([self.zero_state()._replace(w_m=w_m, v_m=v_m)])

    def flow(self, w_m, P_s: float) -> Flow:
        """Flow in every slice; P_s in Pa."""
        return self.glottis.flow([self.zero_state()._replace(w_m=w_m)], P_s)

    def mean_pressure(self, w_m, P_s: float, room_before, dt: float):
        """p_aero averaged over the step, Pa, (nx, ny); ``room_before`` (nx,): smallest G - w one step before, m."""
        return self.glottis.mean_pressure(self.medial - self.whole(w_m), self.flow(w_m, P_s), P_s, room_before, dt)

    def acceleration(self, state: State, P_s: float, contact: bool = True):
        """Accelerations (a_m, a_b, a_phi) of the three unknowns, shapes of the state, m/s² and rad/s²."""
        return self.glottis.acceleration([state], P_s, contact)[0]

    def run(self, state: State, P_s, dt: float, steps: int, scheme: str = "leapfrog", keep_every: int = 0) -> Record:
        """GlottisTwin.march from a state of this fold."""
        record = self.glottis.march((state,), P_s, dt, steps, scheme, keep_every)
        states = [kept for (kept,) in record.states]
        return Record(*record[:5], states, *record.final)

    def static_shape_reference(self, error_m: float = 1e-9, max_steps: int = 2_000_000):
        """Equilibrium at P_s = 0 with contact: (w_m (nx, ny), w_b (nx,)), by damped relaxation; stretch linear.

        The dynamics with every damper replaced by one critical for the lowest mode, stepped explicitly
        until the residual bounds the mass-weighted rms distance to equilibrium: contact only adds
        stiffness, so |q - q*| <= |acceleration| / ω_1².
        """
        undamped = replace(self.constants, C_coup_pa_s_m=0.0, C_foun_pa_s=0.0, C_col_pa_s_m=0.0, eta_m_pa_s=0.0)
        fold = replace(self, constants=undamped)
        system = fold.linear_operators()
        mass = np.diag(system.M)
        squares = eigh(system.K, system.M, eigvals_only=True)
        stiffest = (fold.fields.K_col / fold.fields.rho_s).max()
        omega_1, omega_max = np.sqrt(squares[0]), np.sqrt(squares[-1] + stiffest)
        dt = 1.5 / omega_max
        q, v = fold.pack(fold.zero_state())
        node_area = np.outer(np.full(fold.n, fold.dx), fold.row_width)
        for _ in range(max_steps):
            force = system.load - system.K @ q
            w_m = q[: node_area.size].reshape(node_area.shape)
            push = fold.contact_pressure(w_m, 0 * w_m)[1:-1] * node_area
            force[: node_area.size] -= push.ravel()
            acceleration = force / mass
            if np.sqrt(mass @ acceleration**2 / mass.sum()) < error_m * omega_1**2:
                still = fold.unpack(q, 0 * v)
                return fold.whole(still.w_m), np.pad(still.w_b, 1)
            v = (v + dt * acceleration) / (1 + 2 * omega_1 * dt)
            q = q + dt * v
        raise RuntimeError(f"not at rest after {max_steps} steps")
