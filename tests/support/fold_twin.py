"""Slow, obvious twin of the vocal-fold dynamics; one file, so that every term can be read in one place.

Written from the paper (Serry, Zañartu & Peterson 2026, "Materials and methods"), independent of
the compiled kernel that it checks.

Grid: x_i = i L/(nx-1), i = 0 anterior; y_j = j b/(ny-1), j = 0 superior (outlet), j = ny-1 inferior
(inlet). Arrays are [x, y]. The unknowns are at the n = nx-2 interior x nodes and all ny rows:
membrane w_m (n, ny), beam w_b (n,), and for ``shear="rotation"`` the angle phi (n, ny-1) halfway
between rows. Displacements are 0 at x = 0 and x = L. w > 0 is medial. SI units throughout.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

from tests.support.coefficient_twin import coefficients
from vfcore.fold.terms.air import MIN_GAP_CHANGE_M
from vfcore.spec.fold_constants import FoldConstants


class State(NamedTuple):
    """Displacements (m; phi rad) and their velocities, shapes (n, ny), (n,), (n, ny-1)."""

    w_m: np.ndarray
    w_b: np.ndarray
    phi: np.ndarray
    v_m: np.ndarray
    v_b: np.ndarray
    v_phi: np.ndarray


class Flow(NamedTuple):
    """Flow through the slices: fields over (nx, ny), slice values over (nx,), totals as floats."""

    p_aero: np.ndarray  # Pa
    gap: np.ndarray  # m
    flow_per_width: np.ndarray  # m²/s, positive towards the mouth
    d_min: np.ndarray  # m
    j_sep: np.ndarray  # row of separation; of a closed slice, its closed row nearest the inlet
    A_g_min: float  # m²
    Q_g: float  # m³/s


class LinearSystem(NamedTuple):
    """M q'' + C q' + K q = load (N), without flow and contact; q stacks w_m (row-major), w_b[, phi]."""

    M: np.ndarray
    C: np.ndarray
    K: np.ndarray
    load: np.ndarray


class Record(NamedTuple):
    """Time series of a run; sample k is the state at k·dt, before the step that leaves it."""

    t: np.ndarray  # s, (steps,)
    A_g_min: np.ndarray  # m², (steps,)
    Q_g: np.ndarray  # m³/s, (steps,)
    p_col_max: np.ndarray  # Pa, (steps,); 0 where nothing touches, may be negative at separation
    p_col_max_at: np.ndarray  # (steps, 2), grid node (i, j); (-1, -1) where nothing touches
    states: list[State]  # every ``keep_every``-th state
    final: State


@dataclass(frozen=True)
class FoldTwin:
    """One fold at one posture on one grid."""

    strain: float
    a_ta: float
    theta_g: float
    theta_conv: float = 0.02
    nx: int = 20
    ny: int = 10
    coupling_gradient: str = "inferior_stiff"
    shear: str = "kelvin_voigt"
    constants: FoldConstants = FoldConstants()

    def __post_init__(self):
        def keep(name, value):
            object.__setattr__(self, name, value)

        c, k = self.constants, coefficients(self.constants, self.strain, self.a_ta)
        keep("k", k)
        keep("dx", k.L / (self.nx - 1))
        keep("dy", k.b / (self.ny - 1))
        x, y = np.linspace(0, k.L, self.nx), np.linspace(0, k.b, self.ny)
        keep("x", x)
        keep("y", y)
        keep("n", self.nx - 2)
        keep("medial", np.tan(self.theta_g) * x[:, None] + np.tan(self.theta_conv) * y[None, :])

        # Height of the cell of each row: half a cell at the two edges (trapezoid rule).
        row_width = np.full(self.ny, self.dy)
        row_width[[0, -1]] /= 2
        keep("row_width", row_width)

        towards_inferior = y / k.b
        if self.coupling_gradient == "superior_stiff":
            stiffness = c.K_coup_max_pa_m + (c.K_coup_min_pa_m - c.K_coup_max_pa_m) * towards_inferior
        elif self.coupling_gradient == "inferior_stiff":
            stiffness = c.K_coup_min_pa_m + (c.K_coup_max_pa_m - c.K_coup_min_pa_m) * towards_inferior
        else:
            raise ValueError(self.coupling_gradient)
        keep("K_coup", stiffness)
        if self.shear not in ("kelvin_voigt", "rotation"):
            raise ValueError(self.shear)

        stiffness_force, end_moment_force = self._beam_line_forces()
        keep("beam_operator", stiffness_force / k.rho_l)  # (n, n), 1/s²
        keep("beam_load", end_moment_force / k.rho_l)  # (n,), m/s²

    def _end_moments(self):
        """Prestress part (N·m) and rotational stiffness (N·m per unit slope) of μ̃ w_b'' at x = 0 and x = L."""
        c, k = self.constants, self.k
        # μ̃ w'' = -M̄ - K_ra (θ_g - θ_0) + K_ra λ^{3/2} w' at x = 0; μ̃ w'' = -M̄ - K_rp λ^{3/2} w' at x = L.
        anterior = -k.M_bar - c.K_r_a_n_m * (self.theta_g - c.rest_angle_rad)
        posterior = -k.M_bar
        return anterior, k.lam**1.5 * c.K_r_a_n_m, posterior, k.lam**1.5 * c.K_r_p_n_m

    def _beam_line_forces(self):
        """Matrix (n, n) and constant (n,) of Ñ w'' - μ̃ w'''' in N/m, with one ghost node beyond each end."""
        k, n, dx = self.k, self.n, self.dx
        anterior, K_a, posterior, K_p = self._end_moments()
        # Extended row: [ghost, w(0) = 0, w_1 .. w_n, w(L) = 0, ghost] = extend @ w + offset.
        extend, offset = np.zeros((n + 4, n)), np.zeros(n + 4)
        extend[2:-2] = np.eye(n)
        # x = 0: μ̃ (w_1 + ghost)/dx² = anterior + K_a (w_1 - ghost)/(2 dx), and its mirror at x = L.
        bend, turn_a, turn_p = k.mu_c_tilde / dx**2, K_a / (2 * dx), K_p / (2 * dx)
        extend[0, 0], offset[0] = (turn_a - bend) / (bend + turn_a), anterior / (bend + turn_a)
        extend[-1, -1], offset[-1] = (turn_p - bend) / (bend + turn_p), posterior / (bend + turn_p)
        second, fourth = np.zeros((n, n + 4)), np.zeros((n, n + 4))
        for i in range(n):
            second[i, i + 1 : i + 4] = np.array([1, -2, 1]) / dx**2
            fourth[i, i : i + 5] = np.array([1, -4, 6, -4, 1]) / dx**4
        line_force = k.N_b_tilde * second - k.mu_c_tilde * fourth
        return line_force @ extend, line_force @ offset

    def initial_state(self) -> State:
        """A 1e-9 m bump of the membrane, everything else 0."""
        bump = np.outer(np.sin(np.pi * self.x / self.k.L), np.sin(np.pi * self.y / self.k.b))[1:-1]
        return self.zero_state()._replace(w_m=1e-9 * bump)

    def zero_state(self) -> State:
        n, ny = self.n, self.ny
        return State(*(np.zeros(shape) for shape in 2 * [(n, ny), n, (n, ny - 1)]))

    def whole(self, w_m):
        """Membrane field with its fixed ends: (n, ny) -> (nx, ny)."""
        field = np.zeros((self.nx, self.ny))
        field[1:-1] = w_m
        return field

    def contact_pressure(self, w_m, v_m):
        """p_col over (nx, ny), Pa, including the two fixed slices."""
        w, v, c = self.whole(w_m), self.whole(v_m), self.constants
        overlap = w - self.medial
        return np.where(overlap > 0, c.K_col_pa_m * overlap + c.C_col_pa_s_m * v, 0.0)

    def flow(self, w_m, P_s: float) -> Flow:
        """Quasi-steady viscous Bernoulli flow in every slice; P_s in Pa."""
        c = self.constants
        gap = 2 * np.maximum(self.medial - self.whole(w_m), 0.0)
        d_min, d_max = gap.min(axis=1), gap.max(axis=1)
        d_sep = np.minimum(c.alpha_s * d_min, d_max)
        # The first row from the inlet (last row) whose gap is at most d_sep. In a closed slice d_sep = 0, and this is
        # the closed row nearest the inlet.
        fallen = gap <= d_sep[:, None]
        j_sep = self.ny - 1 - np.argmax(fallen[:, ::-1], axis=1)

        p_aero, flow_per_width = np.zeros_like(gap), np.zeros(self.nx)
        rows = np.arange(self.ny)
        closed = d_min == 0
        shut = closed[:, None] & (rows >= j_sep[:, None])
        p_aero[shut] = P_s

        free = np.flatnonzero(~closed)
        if free.size:
            g = gap[free]
            panels = (1 / g[:, :-1] ** 3 + 1 / g[:, 1:] ** 3) * self.dy / 2
            to_inlet = np.zeros_like(g)  # ∫_y^b dη / d_g³
            to_inlet[:, :-1] = panels[:, ::-1].cumsum(axis=1)[:, ::-1]
            A = c.rho_a_kg_m3 / (2 * d_sep[free] ** 2)
            B = 12 * c.mu_a_pa_s * to_inlet[np.arange(free.size), j_sep[free]]
            # (B - √(B² + 4 A P_s)) / 2A, multiplied out: no cancellation in narrow slices.
            dq = -2 * P_s / (B + np.sqrt(B**2 + 4 * A * P_s)) if P_s > 0 else np.zeros(free.size)
            bernoulli = c.rho_a_kg_m3 / 2 * (dq[:, None] / g) ** 2
            attached = P_s - bernoulli + 12 * c.mu_a_pa_s * dq[:, None] * to_inlet
            p_aero[free] = np.where(rows > j_sep[free, None], attached, 0.0)
            flow_per_width[free] = -dq

        along_x = np.full(self.nx, self.dx)
        along_x[[0, -1]] /= 2
        return Flow(p_aero, gap, flow_per_width, d_min, j_sep, along_x @ d_min, along_x @ flow_per_width)

    def mean_pressure(self, w_m, P_s: float, room_before, dt: float):
        """p_aero (nx, ny), Pa, averaged from half a step before to half a step after, as slices close and open.

        ``room_before`` (nx,): smallest medial − w of each slice one step before. The whole slice is assumed to move at
        the speed of that minimum. A node downstream of the separation has P_s while the slice is closed at it or
        further downstream, and not in a row nearer to the inlet.
        """
        air, room = self.flow(w_m, P_s), self.medial - self.whole(w_m)
        to_here = np.minimum.accumulate(room[:, ::-1], axis=1)[:, ::-1]  # running minimum from the inlet
        pushed = P_s * dt**2 / self.k.rho_s  # by the jumping pressure in one step
        change = np.abs(room.min(axis=1) - room_before) + pushed + MIN_GAP_CHANGE_M
        closed = np.clip(0.5 - to_here / change[:, None], 0.0, 1.0)
        closed_upstream = np.pad(closed, ((0, 0), (0, 1)))[:, 1:]
        attached = np.arange(self.ny) > air.j_sep[:, None]
        return np.where(attached, air.p_aero, np.maximum(closed[:, :1] - closed_upstream, 0.0) * P_s)

    def shear_force(self, state: State):
        """Shear force on the membrane, N/m², and acceleration of the angle, rad/s² (0 for Kelvin–Voigt)."""
        c, k = self.constants, self.k
        gamma, gamma_dot = np.diff(state.w_m, axis=1) / self.dy, np.diff(state.v_m, axis=1) / self.dy
        if self.shear == "rotation":
            gamma, gamma_dot = gamma - state.phi, gamma_dot - state.v_phi
        flux = np.zeros((self.n, self.ny + 1))  # 0 at the free edges
        flux[:, 1:-1] = k.G_m_tilde * gamma + k.eta_m_tilde * gamma_dot
        force = np.diff(flux, axis=1) / self.row_width
        if self.shear == "kelvin_voigt":
            return force, np.zeros_like(state.phi)
        return force, (c.G_m_pa * gamma + c.eta_m_pa_s * gamma_dot) / k.J_m

    def acceleration(self, state: State, P_s: float, contact: bool = True, room_before=None, dt: float = 0.0):
        """Accelerations (a_m, a_b, a_phi) of the three unknowns, shapes of the state, m/s² and rad/s².

        ``room_before`` (nx,): with it the air pressure is ``mean_pressure`` over ``dt``, s.
        """
        c, k = self.constants, self.k
        w = self.whole(state.w_m)
        tension = k.T_m_tilde * (w[:-2] - 2 * w[1:-1] + w[2:]) / self.dx**2
        shear, a_phi = self.shear_force(state)
        coupling = self.K_coup * (state.w_m - state.w_b[:, None]) + c.C_coup_pa_s_m * (state.v_m - state.v_b[:, None])
        averaged = room_before is not None
        p_aero = self.mean_pressure(state.w_m, P_s, room_before, dt) if averaged else self.flow(state.w_m, P_s).p_aero
        load = tension + shear - coupling - p_aero[1:-1]
        if contact:
            load = load - self.contact_pressure(state.w_m, state.v_m)[1:-1]

        foundation = c.K_foun_pa * state.w_b + c.C_foun_pa_s * state.v_b
        a_b = self.beam_operator @ state.w_b + self.beam_load
        a_b = a_b + (coupling @ self.row_width - foundation) / k.rho_l
        return load / k.rho_s, a_b, a_phi

    # ---- time stepping ------------------------------------------------------------------------

    def run(self, state: State, P_s, dt: float, steps: int, scheme: str = "leapfrog", keep_every: int = 0) -> Record:
        """Advance ``steps`` steps of ``dt`` (s) under P_s (Pa, or a function of time).

        ``"euler"``: semi-implicit Euler, every force at the current displacement and velocity.
        ``"leapfrog"``: velocities half a step behind (v given is that of t - dt/2); the beam's
        tension, bending and end moments by the trapezoidal rule; velocity-dependent forces at
        v + (v - v of the previous step)/2; membrane and rotation by Störmer's formula of third order; the air
        pressure of slices that close or open is averaged over the step.
        The recorded contact pressure is the applied one.
        """
        if scheme == "leapfrog":
            beam_filter = np.linalg.inv(np.eye(self.n) - dt**2 / 4 * self.beam_operator)
        elif scheme == "euler":
            beam_filter = np.eye(self.n)
        else:
            raise ValueError(scheme)
        pressure = P_s if callable(P_s) else (lambda t: P_s)
        area, flow, peak = (np.empty(steps) for _ in range(3))
        peak_at = np.full((steps, 2), -1)
        states, before, room_before = [], state, np.zeros(self.nx)
        for step in range(steps):
            if keep_every and step % keep_every == 0:
                states.append(state)
            now = state
            if scheme == "leapfrog":
                now = state._replace(
                    v_m=state.v_m + (state.v_m - before.v_m) / 2,
                    v_b=state.v_b + (state.v_b - before.v_b) / 2,
                    v_phi=state.v_phi + (state.v_phi - before.v_phi) / 2,
                )
            P_now = pressure(step * dt)
            averaged = {"room_before": room_before, "dt": dt} if scheme == "leapfrog" else {}
            a_m, a_b, a_phi = self.acceleration(now, P_now, **averaged)
            room_before = (self.medial - self.whole(now.w_m)).min(axis=1)
            a_b = beam_filter @ a_b
            v_m, v_b, v_phi = state.v_m + dt * a_m, state.v_b + dt * a_b, state.v_phi + dt * a_phi

            air = self.flow(now.w_m, P_now)
            area[step], flow[step] = air.A_g_min, air.Q_g
            peak[step], peak_at[step] = self.contact_peak(now.w_m, now.v_m)
            w_m, w_b, phi = state.w_m + dt * v_m, state.w_b + dt * v_b, state.phi + dt * v_phi
            if scheme == "leapfrog":
                w_m = w_m + dt / 12 * (v_m - 2 * state.v_m + before.v_m)
                phi = phi + dt / 12 * (v_phi - 2 * state.v_phi + before.v_phi)
            before = state
            state = State(w_m, w_b, phi, v_m, v_b, v_phi)
        if not all(np.isfinite(part).all() for part in state):
            raise FloatingPointError(f"the twin diverged within {steps} steps of {dt:g} s")
        return Record(np.arange(steps) * dt, area, flow, peak, peak_at, states, state)

    def contact_peak(self, w_m, v_m):
        """Largest contact pressure (Pa) among touching nodes and its grid node (i, j); 0, (-1, -1) if none touch."""
        touching = self.whole(w_m) > self.medial
        if not touching.any():
            return 0.0, (-1, -1)
        pressure = np.where(touching, self.contact_pressure(w_m, v_m), -np.inf)
        node = np.unravel_index(np.argmax(pressure), pressure.shape)
        return pressure[node], node

    # ---- the linear system: no air, no contact --------------------------------------------------

    def linear_operators(self) -> LinearSystem:
        """Symmetric mass, damping and stiffness matrices and the load, from the energies of the grid.

        Built from elastic links and lumped masses rather than from ``acceleration``: the end moments
        enter as rotational springs in series with the adjacent half cell, k/(1 + k dx/2μ̃).
        """
        c, k, n, ny, dx, dy = self.constants, self.k, self.n, self.ny, self.dx, self.dy
        with_phi = self.shear == "rotation"
        size = n * ny + n + (n * (ny - 1) if with_phi else 0)
        M, C, K, load = np.zeros(size), np.zeros((size, size)), np.zeros((size, size)), np.zeros(size)
        m = np.arange(n * ny).reshape(n, ny)
        beam = n * ny + np.arange(n)
        phi = n * ny + n + np.arange(n * (ny - 1)).reshape(n, ny - 1)

        def link(matrix, stiffness, *ends):
            """Energy ½ stiffness (Σ factor·q)² over ``ends`` = (index, factor)."""
            for p, fp in ends:
                for q, fq in ends:
                    matrix[p, q] += stiffness * fp * fq

        def string(matrix, nodes, tension):
            """A string of nodes between two fixed ends."""
            link(matrix, tension / dx, (nodes[0], 1))
            for left, right in zip(nodes[:-1], nodes[1:], strict=True):
                link(matrix, tension / dx, (left, -1), (right, 1))
            link(matrix, tension / dx, (nodes[-1], 1))

        for j, width in enumerate(self.row_width):
            string(K, m[:, j], k.T_m_tilde * width)
            for i in range(n):
                M[m[i, j]] = k.rho_s * width * dx
                link(K, self.K_coup[j] * width * dx, (m[i, j], 1), (beam[i], -1))
                link(C, c.C_coup_pa_s_m * width * dx, (m[i, j], 1), (beam[i], -1))
        for i in range(n):
            for j in range(ny - 1):
                ends = [(m[i, j + 1], 1 / dy), (m[i, j], -1 / dy)] + ([(phi[i, j], -1)] if with_phi else [])
                link(K, k.G_m_tilde * dx * dy, *ends)
                link(C, k.eta_m_tilde * dx * dy, *ends)
                if with_phi:  # J_m goes with G_m as the membrane's G̃_m does: both times d_muc/λ
                    M[phi[i, j]] = k.d_muc / k.lam * k.J_m * dx * dy

        string(K, beam, k.N_b_tilde)
        for i in range(n):
            M[beam[i]] = k.rho_l * dx
            link(K, c.K_foun_pa * dx, (beam[i], 1))
            link(C, c.C_foun_pa_s * dx, (beam[i], 1))
            neighbours = [(beam[p], f) for p, f in ((i - 1, 1), (i, -2), (i + 1, 1)) if 0 <= p < n]
            link(K, k.mu_c_tilde / dx**3, *neighbours)
        anterior, K_a, posterior, K_p = self._end_moments()
        for node, moment, spring in ((beam[0], anterior, K_a), (beam[-1], posterior, K_p)):
            series = 1 + spring * dx / (2 * k.mu_c_tilde)
            link(K, spring / series / dx**2, (node, 1))
            load[node] = -moment / series / dx
        return LinearSystem(np.diag(M), C, K, load)

    def pack(self, state: State):
        """Displacement and velocity vectors of ``linear_operators`` from a state."""
        q, v = [state.w_m.ravel(), state.w_b], [state.v_m.ravel(), state.v_b]
        if self.shear == "rotation":
            q, v = q + [state.phi.ravel()], v + [state.v_phi.ravel()]
        return np.concatenate(q), np.concatenate(v)

    def unpack(self, q, v) -> State:
        """The inverse of ``pack``."""
        n, ny, zero = self.n, self.ny, self.zero_state()
        parts = [(z[: n * ny].reshape(n, ny), z[n * ny : n * ny + n], z[n * ny + n :]) for z in (q, v)]
        (w_m, w_b, phi), (v_m, v_b, v_phi) = parts
        if self.shear == "kelvin_voigt":
            phi, v_phi = zero.phi, zero.v_phi
        return State(w_m, w_b, phi.reshape(n, ny - 1), v_m, v_b, v_phi.reshape(n, ny - 1))

    def mode_frequencies(self, count: int = 6):
        """The lowest undamped natural frequencies, Hz."""
        system = self.linear_operators()
        return np.sqrt(eigh(system.K, system.M, eigvals_only=True)[:count]) / (2 * np.pi)

    def linear_reference(self, state: State, times, relative_tolerance: float = 1e-10) -> list[State]:
        """States at ``times`` (s, from 0) of the linear system, by an eighth-order adaptive integrator."""
        system, (q, v) = self.linear_operators(), self.pack(state)
        mass = np.diag(system.M)

        def rate(_, z):
            q, v = np.split(z, 2)
            return np.concatenate([v, (system.load - system.K @ q - system.C @ v) / mass])

        z = np.concatenate([q, v])
        # Scales of the motion, so that absolute tolerances mean the same for every unknown.
        length = max(np.abs(q).max(), np.abs(np.linalg.solve(system.K, system.load)).max())
        scale = np.repeat([length, length * 2 * np.pi * self.mode_frequencies(1)[0]], q.size)
        solution = solve_ivp(
            rate, (0, times[-1]), z, "DOP853", times, rtol=relative_tolerance, atol=relative_tolerance * scale
        )
        if not solution.success:
            raise RuntimeError(solution.message)
        return [self.unpack(*np.split(column, 2)) for column in solution.y.T]

    def linear_energy(self, state: State) -> float:
        """Kinetic + elastic energy less the work of the load, J (no air, no contact)."""
        system, (q, v) = self.linear_operators(), self.pack(state)
        return v @ system.M @ v / 2 + q @ system.K @ q / 2 - system.load @ q

    # ---- static shape -----------------------------------------------------------------------------

    def static_shape_reference(self, error_m: float = 1e-9, max_steps: int = 2_000_000):
        """Equilibrium at P_s = 0 with contact: (w_m (nx, ny), w_b (nx,)), by damped relaxation.

        The dynamics with every damper replaced by one critical for the lowest mode, stepped explicitly
        until the residual bounds the mass-weighted rms distance to equilibrium: contact only adds
        stiffness, so |q - q*| <= |acceleration| / ω_1².
        """
        undamped = replace(self.constants, C_coup_pa_s_m=0.0, C_foun_pa_s=0.0, C_col_pa_s_m=0.0, eta_m_pa_s=0.0)
        fold = replace(self, constants=undamped)
        system = fold.linear_operators()
        mass = np.diag(system.M)
        squares = eigh(system.K, system.M, eigvals_only=True)
        omega_1, omega_max = np.sqrt(squares[0]), np.sqrt(squares[-1] + undamped.K_col_pa_m / fold.k.rho_s)
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
