"""Twin of a glottis: one wall with its mirror image, or a left and a right wall that differ; contact, air, time steps.

Two walls meet at the same fractions x/L and y/b. With G - w the distance of a wall from the medial plane,

    h = ((G - w)_left + (G - w)_right)/2            half the gap, negative where the walls overlap
    p_col = K_col (-h) + C_col (v_left + v_right)/2  where h < 0, on both walls
    K_col = 2 K_left K_right/(K_left + K_right)      springs in series, C_col likewise

The air sees the gap 2h; its slices have the mean width and its nodes the mean distance of the two walls. Both walls
feel the same air pressure at the same fractions. For equal walls this is the paper's law. Time stepping:
docs/model/numerics.md, "Time stepping". SI units.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from tests.support.flow_twin import AirTwin, Flow
from tests.support.wall_twin import State, WallTwin

States = tuple[State, ...]


class Record(NamedTuple):
    """Time series of a march; sample k is the state at k·dt, before the step that leaves it."""

    t: np.ndarray  # s, (steps,)
    A_g_min: np.ndarray  # m², (steps,)
    Q_g: np.ndarray  # m³/s, (steps,)
    p_col_max: np.ndarray  # Pa, (steps,); 0 where nothing touches, may be negative at separation
    p_col_max_at: np.ndarray  # (steps, 2), grid node (i, j); (-1, -1) where nothing touches
    mean_w: np.ndarray  # m, (steps, walls): membrane displacement, mean over the surface of each wall
    states: list[States]  # every ``keep_every``-th
    final: States


def in_series(left, right):
    """2 a b/(a + b), and 0 where both are 0."""
    total = left + right
    return np.divide(2 * left * right, total, out=np.zeros_like(total), where=total > 0)


@dataclass(frozen=True)
class GlottisTwin:
    """One wall (mirrored) or two walls (left, right) on the same number of nodes. Air constants: of the first wall."""

    walls: tuple[WallTwin, ...]
    air_law: type[AirTwin] = AirTwin

    def __post_init__(self):
        if len({(wall.nx, wall.ny) for wall in self.walls}) != 1 or len(self.walls) not in (1, 2):
            raise ValueError("one wall or two on the same number of nodes")

    @cached_property
    def air(self) -> AirTwin:
        c = self.walls[0].constants
        dx, dy = (np.mean([getattr(wall, name) for wall in self.walls]) for name in ("dx", "dy"))
        return self.air_law(dx, dy, c.alpha_s, c.rho_a_kg_m3, c.mu_a_pa_s)

    @cached_property
    def contact_stiffness(self):
        """K_col of the pair, Pa/m, (nx, ny)."""
        return in_series(self.walls[0].fields.K_col, self.walls[-1].fields.K_col)

    @cached_property
    def contact_damper(self):
        """C_col of the pair, Pa·s/m, (nx, ny)."""
        return in_series(self.walls[0].fields.C_col, self.walls[-1].fields.C_col)

    def half_gap(self, states: Sequence[State]):
        """h, m, (nx, ny)."""
        return self._mean(wall.medial - wall.whole(s.w_m) for wall, s in zip(self.walls, states, strict=True))

    def _mean(self, per_wall):
        return sum(per_wall) / len(self.walls)

    def contact_pressure(self, states: Sequence[State]):
        """p_col, Pa, (nx, ny)."""
        return self._contact_pressure(self.half_gap(states), states)

    def _contact_pressure(self, h, states: Sequence[State]):
        v = self._mean(wall.whole(s.v_m) for wall, s in zip(self.walls, states, strict=True))
        return np.where(h < 0, self.contact_stiffness * -h + self.contact_damper * v, 0.0)

    def flow(self, states: Sequence[State], P_s: float) -> Flow:
        return self.air.flow(self.half_gap(states), P_s)

    def mean_pressure(self, h, air: Flow, P_s: float, narrowest_before, dt: float):
        """p_aero averaged over the step (AirTwin.mean_pressure), Pa, (nx, ny); ``air``: the flow through ``h``.

        The lung pressure moves each wall by P_s dt²/ρ_s in one step; ρ_s is that of the fold without patches.
        """
        pushed = self._mean(P_s * dt**2 / wall.k.rho_s for wall in self.walls)
        return self.air.mean_pressure(h, air, P_s, narrowest_before, pushed)

    def acceleration(self, states: Sequence[State], P_s: float, contact: bool = True):
        """Accelerations (a_m, a_b, a_phi) of each wall, m/s² and rad/s², at the instantaneous air pressure."""
        pressure = self.flow(states, P_s).p_aero
        if contact:
            pressure = pressure + self.contact_pressure(states)
        return self._accelerations(states, pressure)

    def _accelerations(self, states: Sequence[State], pressure):
        return [wall.acceleration_under(s, pressure) for wall, s in zip(self.walls, states, strict=True)]

    def initial_states(self) -> States:
        return tuple(wall.initial_state() for wall in self.walls)

    def march(
        self,
        states: Sequence[State],
        P_s: float | Callable[[float], float],
        dt: float,
        steps: int,
        scheme: str = "leapfrog",
        keep_every: int = 0,
    ) -> Record:
        """Advance ``steps`` steps of ``dt`` (s) under P_s (Pa, or a function of time).

        ``"euler"``: semi-implicit Euler, every force at the current displacement and velocity.
        ``"leapfrog"``: velocities half a step behind (v given is that of t - dt/2); the beam's
        tension at the prestrain, bending and end moments by the trapezoidal rule; velocity-dependent forces at
        v + (v - v of the previous step)/2; membrane and rotation by Störmer's formula of third order; the air
        pressure of slices that close or open is averaged over the step.
        The recorded contact pressure is the applied one.
        """
        leapfrog = scheme == "leapfrog"
        if scheme not in ("leapfrog", "euler"):
            raise ValueError(scheme)
        filters = [
            np.linalg.inv(np.eye(wall.n) - dt**2 / 4 * wall.beam_operator) if leapfrog else np.eye(wall.n)
            for wall in self.walls
        ]
        surface = [np.outer(np.full(wall.n, wall.dx), wall.row_width) / (wall.k.L * wall.k.b) for wall in self.walls]
        pressure = P_s if callable(P_s) else (lambda t: P_s)
        area, flow, peak = (np.empty(steps) for _ in range(3))
        peak_at, mean_w = np.full((steps, 2), -1), np.empty((steps, len(self.walls)))
        kept, states = [], tuple(states)
        before, narrowest = states, np.zeros(self.walls[0].nx)
        for step in range(steps):
            if keep_every and step % keep_every == 0:
                kept.append(states)
            now = tuple(map(extrapolated, states, before)) if leapfrog else states
            P_now, h = pressure(step * dt), self.half_gap(now)
            air, p_col = self.air.flow(h, P_now), self._contact_pressure(h, now)
            area[step], flow[step] = air.A_g_min, air.Q_g
            peak[step], peak_at[step] = largest(p_col, h < 0)
            p_aero = self.mean_pressure(h, air, P_now, narrowest, dt) if leapfrog else air.p_aero
            accelerations = self._accelerations(now, p_aero + p_col)
            narrowest = h.min(axis=1)
            mean_w[step] = [(cells * s.w_m).sum() for cells, s in zip(surface, now, strict=True)]

            after = []
            for s, b, (a_m, a_b, a_phi), beam_filter in zip(states, before, accelerations, filters, strict=True):
                v_m, v_b, v_phi = s.v_m + dt * a_m, s.v_b + dt * (beam_filter @ a_b), s.v_phi + dt * a_phi
                w_m, w_b, phi = s.w_m + dt * v_m, s.w_b + dt * v_b, s.phi + dt * v_phi
                if leapfrog:
                    w_m = w_m + dt / 12 * (v_m - 2 * s.v_m + b.v_m)
                    phi = phi + dt / 12 * (v_phi - 2 * s.v_phi + b.v_phi)
                after.append(State(w_m, w_b, phi, v_m, v_b, v_phi))
            before, states = states, tuple(after)
        if not all(np.isfinite(part).all() for state in states for part in state):
            raise FloatingPointError(f"the twin diverged within {steps} steps of {dt:g} s")
        return Record(np.arange(steps) * dt, area, flow, peak, peak_at, mean_w, kept, states)

    def half_step_back(self, states: Sequence[State], dt: float, P_s: float = 0.0) -> States:
        """States whose velocities are moved from t to t - dt/2, where the leapfrog has them."""
        return tuple(
            s._replace(v_m=s.v_m - dt / 2 * a_m, v_b=s.v_b - dt / 2 * a_b, v_phi=s.v_phi - dt / 2 * a_phi)
            for s, (a_m, a_b, a_phi) in zip(states, self.acceleration(states, P_s), strict=True)
        )

    def reference(self, states: Sequence[State], times, P_s: float = 0.0, tolerance: float = 1e-10) -> list[States]:
        """States at ``times`` (s, from 0) without contact, by an eighth-order adaptive integrator.

        ``tolerance``: error of a displacement relative to the largest one, roughly.
        """
        shapes = [part.shape for state in states for part in state]
        cuts = np.cumsum([int(np.prod(shape)) for shape in shapes])[:-1]

        def unpacked(z) -> States:
            parts = [part.reshape(shape) for part, shape in zip(np.split(z, cuts), shapes, strict=True)]
            return tuple(State(*parts[i : i + 6]) for i in range(0, len(parts), 6))

        def packed(parts):
            return np.concatenate([part.ravel() for part in parts])

        def rate(_, z):
            now = unpacked(z)
            accelerations = self.acceleration(now, P_s, contact=False)
            return packed(
                part
                for s, (a_m, a_b, a_phi) in zip(now, accelerations, strict=True)
                for part in (s.v_m, s.v_b, s.v_phi, a_m, a_b, a_phi)
            )

        z = packed(part for state in states for part in state)
        length = max(1e-6, *(np.abs(state.w_m).max() for state in states))
        scale = packed(
            np.full(part.shape, length if is_w else length * 2 * np.pi * 100.0)
            for state in states
            for part, is_w in zip(state, (True, True, True, False, False, False), strict=True)
        )
        solution = solve_ivp(rate, (0, times[-1]), z, "DOP853", times, rtol=tolerance, atol=tolerance * scale)
        if not solution.success:
            raise RuntimeError(solution.message)
        return [unpacked(column) for column in solution.y.T]


def largest(pressure, touching):
    """Largest contact pressure (Pa) among touching nodes and its grid node (i, j); 0, (-1, -1) if none touch."""
    if not touching.any():
        return 0.0, (-1, -1)
    node = np.unravel_index(np.argmax(np.where(touching, pressure, -np.inf)), pressure.shape)
    return pressure[node], node


def extrapolated(state: State, before: State) -> State:
    """The state with its velocities moved half a step on, from those of this step and of the one before."""
    return state._replace(
        v_m=state.v_m + (state.v_m - before.v_m) / 2,
        v_b=state.v_b + (state.v_b - before.v_b) / 2,
        v_phi=state.v_phi + (state.v_phi - before.v_phi) / 2,
    )
