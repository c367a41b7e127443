"""Slow, obvious twin of the tissue of one vocal fold: one wall of the glottis, without air and contact.

Written from the paper (Serry, Zañartu & Peterson 2026, "Materials and methods"), independent of the compiled kernel
that it checks. Finite stretch: tests/support/stretch_twin.py.

Grid: x_i = i L/(nx-1), i = 0 anterior; y_j = j b/(ny-1), j = 0 superior (outlet), j = ny-1 inferior
(inlet). Arrays are [x, y]. The unknowns are at the n = nx-2 interior x nodes and all ny rows:
membrane w_m (n, ny), beam w_b (n,), and for ``shear="rotation"`` the angle phi (n, ny-1) halfway
between rows. Displacements are 0 at x = 0 and x = L. w > 0 is medial. SI units throughout.
"""

from dataclasses import dataclass, field, replace
from typing import NamedTuple, Self

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

from tests.support import stretch_twin
from tests.support.coefficient_twin import TwinCoefficients, coefficients
from vfcore.fold.constants import FoldConstants


class State(NamedTuple):
    """Displacements (m; phi rad) and their velocities, shapes (n, ny), (n,), (n, ny-1)."""

    w_m: np.ndarray
    w_b: np.ndarray
    phi: np.ndarray
    v_m: np.ndarray
    v_b: np.ndarray
    v_phi: np.ndarray


class Fields(NamedTuple):
    """Material over the surface. At the nodes (nx, ny), between nodes along x (nx-1, ny) or along y (nx, ny-1)."""

    rho_s: np.ndarray  # nodes, kg/m²
    tau: np.ndarray  # along x, ratio of the tension to that of the row
    G_m: np.ndarray  # along y, G̃_m, N/m
    eta_m: np.ndarray  # along y, η̃_m, N·s/m
    K_coup: np.ndarray  # nodes, Pa/m
    C_coup: np.ndarray  # nodes, Pa·s/m
    K_col: np.ndarray  # nodes, Pa/m
    C_col: np.ndarray  # nodes, Pa·s/m
    medial: np.ndarray  # nodes, G, m


class LinearSystem(NamedTuple):
    """M q'' + C q' + K q = load (N), without flow and contact; q stacks w_m (row-major), w_b[, phi]."""

    M: np.ndarray
    C: np.ndarray
    K: np.ndarray
    load: np.ndarray


@dataclass(frozen=True, eq=False)
class WallTwin:
    """One fold at one posture on one grid. ``given``: fields that differ from those of a uniform fold, by name."""

    strain: float
    a_ta: float
    theta_g: float
    theta_conv: float = 0.02
    nx: int = 20
    ny: int = 10
    coupling_gradient: str = "inferior_stiff"
    shear: str = "kelvin_voigt"
    constants: FoldConstants = FoldConstants()
    stretch: str = "linear"
    given: dict[str, np.ndarray] = field(default_factory=dict)
    # Follow from the above.
    k: TwinCoefficients = field(init=False)
    n: int = field(init=False)  # inner nodes along x
    dx: float = field(init=False)
    dy: float = field(init=False)
    x: np.ndarray = field(init=False)
    y: np.ndarray = field(init=False)
    row_width: np.ndarray = field(init=False)  # height of the cell of each row, m
    K_coup: np.ndarray = field(init=False)  # of each row of a uniform fold, Pa/m
    fields: Fields = field(init=False)
    medial: np.ndarray = field(init=False)  # G at the nodes, m
    beam_operator: np.ndarray = field(init=False)  # (n, n), 1/s²
    beam_load: np.ndarray = field(init=False)  # (n,), m/s²

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
        if self.stretch not in ("linear", "finite"):
            raise ValueError(self.stretch)

        nodes, along_x, along_y = (self.nx, self.ny), (self.nx - 1, self.ny), (self.nx, self.ny - 1)
        uniform = Fields(
            rho_s=np.full(nodes, k.rho_s),
            tau=np.ones(along_x),
            G_m=np.full(along_y, k.G_m_tilde),
            eta_m=np.full(along_y, k.eta_m_tilde),
            K_coup=np.tile(stiffness, (self.nx, 1)),
            C_coup=np.full(nodes, c.C_coup_pa_s_m),
            K_col=np.full(nodes, c.K_col_pa_m),
            C_col=np.full(nodes, c.C_col_pa_s_m),
            medial=np.tan(self.theta_g) * x[:, None] + np.tan(self.theta_conv) * y[None, :],
        )
        for name, value in self.given.items():
            if value.shape != getattr(uniform, name).shape:
                raise ValueError(f"{name} has the shape {value.shape}")
        keep("fields", uniform._replace(**self.given))
        keep("medial", self.fields.medial)

        stiffness_force, end_moment_force = self._beam_line_forces()
        keep("beam_operator", stiffness_force / k.rho_l)
        keep("beam_load", end_moment_force / k.rho_l)

    def with_fields(self, **given: np.ndarray) -> Self:
        """The same fold with other fields."""
        return replace(self, given=self.given | given)

    def end_moments(self):
        """Prestress part (N·m) and rotational stiffness (N·m per unit slope) of μ̃ w_b'' at x = 0 and x = L."""
        c, k = self.constants, self.k
        # μ̃ w'' = -M̄ - K_ra (θ_g - θ_0) + K_ra λ^{3/2} w' at x = 0; μ̃ w'' = -M̄ - K_rp λ^{3/2} w' at x = L.
        anterior = -k.M_bar - c.K_r_a_n_m * (self.theta_g - c.rest_angle_rad)
        posterior = -k.M_bar
        return anterior, k.lam**1.5 * c.K_r_a_n_m, posterior, k.lam**1.5 * c.K_r_p_n_m

    def _beam_line_forces(self):
        """Matrix (n, n) and constant (n,) of Ñ w'' - μ̃ w'''' in N/m, with one ghost node beyond each end."""
        k, n, dx = self.k, self.n, self.dx
        extend, offset = self.extended_beam()
        second, fourth = np.zeros((n, n + 4)), np.zeros((n, n + 4))
        for i in range(n):
            second[i, i + 1 : i + 4] = np.array([1, -2, 1]) / dx**2
            fourth[i, i : i + 5] = np.array([1, -4, 6, -4, 1]) / dx**4
        line_force = k.N_b_tilde * second - k.mu_c_tilde * fourth
        return line_force @ extend, line_force @ offset

    def extended_beam(self):
        """Matrix (n+4, n) and constant (n+4,) of the row [ghost, w(0) = 0, w_1 .. w_n, w(L) = 0, ghost], m."""
        k, n, dx = self.k, self.n, self.dx
        anterior, K_a, posterior, K_p = self.end_moments()
        extend, offset = np.zeros((n + 4, n)), np.zeros(n + 4)
        extend[2:-2] = np.eye(n)
        # x = 0: μ̃ (w_1 + ghost)/dx² = anterior + K_a (w_1 - ghost)/(2 dx), and its mirror at x = L.
        bend, turn_a, turn_p = k.mu_c_tilde / dx**2, K_a / (2 * dx), K_p / (2 * dx)
        extend[0, 0], offset[0] = (turn_a - bend) / (bend + turn_a), anterior / (bend + turn_a)
        extend[-1, -1], offset[-1] = (turn_p - bend) / (bend + turn_p), posterior / (bend + turn_p)
        return extend, offset

    def initial_state(self) -> State:
        """A 1e-9 m bump of the membrane, everything else 0."""
        bump = np.outer(np.sin(np.pi * self.x / self.k.L), np.sin(np.pi * self.y / self.k.b))[1:-1]
        return self.zero_state()._replace(w_m=1e-9 * bump)

    def zero_state(self) -> State:
        n, ny = self.n, self.ny
        return State(*(np.zeros(shape) for shape in 2 * [(n, ny), n, (n, ny - 1)]))

    def whole(self, w_m):
        """Membrane field with its fixed ends: (n, ny) -> (nx, ny)."""
        whole = np.zeros((self.nx, self.ny))
        whole[1:-1] = w_m
        return whole

    # ---- forces of the tissue -------------------------------------------------------------------

    def row_tension(self, w_m):
        """T̃ of each row, N/m, (ny,)."""
        if self.stretch == "linear":
            return np.full(self.ny, self.k.T_m_tilde)
        e = stretch_twin.mean_square_stretch(self.whole(w_m), self.dx, self.fields.tau)
        return stretch_twin.membrane_tension(self.constants, self.k, self.strain + self.k.lam * e)

    def beam_tension(self, w_b) -> float:
        """Ñ_b, N."""
        if self.stretch == "linear":
            return self.k.N_b_tilde
        e = stretch_twin.mean_square_stretch(np.pad(w_b, 1), self.dx)
        return float(stretch_twin.beam_force(self.constants, self.k, self.a_ta, self.strain + self.k.lam * e))

    def tension_force(self, w_m):
        """∂_x(τ T̃ ∂_x w), N/m², (n, ny)."""
        pull = self.fields.tau * self.row_tension(w_m) * np.diff(self.whole(w_m), axis=0) / self.dx
        return np.diff(pull, axis=0) / self.dx

    def shear_force(self, state: State):
        """Shear force on the membrane, N/m², and acceleration of the angle, rad/s² (0 for Kelvin–Voigt)."""
        k, G, eta = self.k, self.fields.G_m[1:-1], self.fields.eta_m[1:-1]
        gamma, gamma_dot = np.diff(state.w_m, axis=1) / self.dy, np.diff(state.v_m, axis=1) / self.dy
        if self.shear == "rotation":
            gamma, gamma_dot = gamma - state.phi, gamma_dot - state.v_phi
        flux = np.zeros((self.n, self.ny + 1))  # 0 at the free edges
        flux[:, 1:-1] = G * gamma + eta * gamma_dot
        force = np.diff(flux, axis=1) / self.row_width
        if self.shear == "kelvin_voigt":
            return force, np.zeros_like(state.phi)
        return force, flux[:, 1:-1] * k.lam / k.d_muc / k.J_m  # G_m = G̃_m λ/d_muc

    def coupling_traction(self, state: State):
        """Pull of the membrane on the beam, N/m², (n, ny); the beam pulls back with the same."""
        K, C = self.fields.K_coup[1:-1], self.fields.C_coup[1:-1]
        return K * (state.w_m - state.w_b[:, None]) + C * (state.v_m - state.v_b[:, None])

    def acceleration_under(self, state: State, pressure):
        """Accelerations (a_m, a_b, a_phi), m/s² and rad/s², with ``pressure`` (nx, ny), Pa, on the medial surface."""
        c, k = self.constants, self.k
        shear, a_phi = self.shear_force(state)
        coupling = self.coupling_traction(state)
        force = self.tension_force(state.w_m) + shear - coupling - pressure[1:-1]

        foundation = c.K_foun_pa * state.w_b + c.C_foun_pa_s * state.v_b
        stretched = (self.beam_tension(state.w_b) - k.N_b_tilde) * np.diff(np.pad(state.w_b, 1), 2) / self.dx**2
        a_b = self.beam_operator @ state.w_b + self.beam_load
        a_b = a_b + (coupling @ self.row_width - foundation + stretched) / k.rho_l
        return force / self.fields.rho_s[1:-1], a_b, a_phi

    # ---- the linear system: no air, no contact --------------------------------------------------

    def linear_operators(self) -> LinearSystem:
        """Symmetric mass, damping and stiffness matrices and the load, from the energies of the grid.

        Built from elastic links and lumped masses rather than from ``acceleration_under``: the end moments
        enter as rotational springs in series with the adjacent half cell, k/(1 + k dx/2μ̃). Finite stretch is left out.
        """
        c, k, n, ny, dx, dy, f = self.constants, self.k, self.n, self.ny, self.dx, self.dy, self.fields
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
            """A string of nodes between two fixed ends; ``tension`` of each of its intervals."""
            link(matrix, tension[0] / dx, (nodes[0], 1))
            for left, right, pull in zip(nodes[:-1], nodes[1:], tension[1:-1], strict=True):
                link(matrix, pull / dx, (left, -1), (right, 1))
            link(matrix, tension[-1] / dx, (nodes[-1], 1))

        for j, width in enumerate(self.row_width):
            string(K, m[:, j], k.T_m_tilde * f.tau[:, j] * width)
            for i in range(n):
                M[m[i, j]] = f.rho_s[i + 1, j] * width * dx
                link(K, f.K_coup[i + 1, j] * width * dx, (m[i, j], 1), (beam[i], -1))
                link(C, f.C_coup[i + 1, j] * width * dx, (m[i, j], 1), (beam[i], -1))
        for i in range(n):
            for j in range(ny - 1):
                ends = [(m[i, j + 1], 1 / dy), (m[i, j], -1 / dy)] + ([(phi[i, j], -1)] if with_phi else [])
                link(K, f.G_m[i + 1, j] * dx * dy, *ends)
                link(C, f.eta_m[i + 1, j] * dx * dy, *ends)
                if with_phi:  # J_m goes with G_m as the membrane's G̃_m does: both times d_muc/λ
                    M[phi[i, j]] = k.d_muc / k.lam * k.J_m * dx * dy

        string(K, beam, np.full(n + 1, k.N_b_tilde))
        for i in range(n):
            M[beam[i]] = k.rho_l * dx
            link(K, c.K_foun_pa * dx, (beam[i], 1))
            link(C, c.C_foun_pa_s * dx, (beam[i], 1))
            neighbours = [(beam[p], f) for p, f in ((i - 1, 1), (i, -2), (i + 1, 1)) if 0 <= p < n]
            link(K, k.mu_c_tilde / dx**3, *neighbours)
        anterior, K_a, posterior, K_p = self.end_moments()
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
