"""Energy of the folds, term by term, and the power that each term loses or takes in. From the equations, per grid.

Displacement and velocity of a state are at the same time here. Integrals are sums over cells: nodes of the membrane
have the area dx · (height of the row), intervals between nodes dx · dy, nodes of the beam the length dx. The derivative
of the energy with respect to a displacement is, with the opposite sign, the force of the discrete equation.

Contact between two walls acts on both with the same pressure. With equal node areas it has the energy K_col h² per
node; with areas a_left ≠ a_right no energy exists that gives both forces. The energy is then that of the mean area, and
``contact_mismatch`` is the power left over, p_el (a_left − a_right)/2 (v_left − v_right).

Joule and watt.
"""

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from tests.support import stretch_twin
from tests.support.glottis_twin import GlottisTwin, States
from tests.support.wall_twin import State, WallTwin


def node_area(wall: WallTwin):
    """Area of the cells of the membrane's nodes inside the fixed ends, m², (n, ny)."""
    return wall.dx * np.tile(wall.row_width, (wall.n, 1))


def shear_rates(wall: WallTwin, state: State):
    """Shear angle and its rate between rows, (n, ny-1)."""
    gamma, rate = np.diff(state.w_m, axis=1) / wall.dy, np.diff(state.v_m, axis=1) / wall.dy
    if wall.shear == "rotation":
        gamma, rate = gamma - state.phi, rate - state.v_phi
    return gamma, rate


def tissue_energy(wall: WallTwin, state: State) -> dict[str, float]:
    """Kinetic and stored energy of one wall, J. The beam's end moments may make their part negative."""
    c, k, f, area = wall.constants, wall.k, wall.fields, node_area(wall)
    gamma, _ = shear_rates(wall, state)
    e_rows = stretch_twin.mean_square_stretch(wall.whole(state.w_m), wall.dx, f.tau)
    e_beam = stretch_twin.mean_square_stretch(np.pad(state.w_b, 1), wall.dx)
    if wall.stretch == "finite":
        rows = stretch_twin.membrane_work(c, k, wall.strain, e_rows)
        axial = stretch_twin.beam_work(c, k, wall.a_ta, wall.strain, e_beam)
    else:
        rows, axial = k.T_m_tilde * e_rows, k.N_b_tilde * e_beam

    extend, offset = wall.extended_beam()
    line = extend @ state.w_b + offset
    curvature = np.diff(line, 2) / wall.dx**2  # at all nodes, both ends included
    slope_a, slope_p = (line[2] - line[0]) / (2 * wall.dx), (line[-1] - line[-3]) / (2 * wall.dx)
    anterior, K_a, posterior, K_p = wall.end_moments()
    half_at_ends = np.full(curvature.size, wall.dx)
    half_at_ends[[0, -1]] /= 2
    return {
        "kinetic_membrane": float((f.rho_s[1:-1] * area * state.v_m**2).sum() / 2),
        "kinetic_beam": float(k.rho_l * wall.dx * (state.v_b**2).sum() / 2),
        # J_m goes with G_m as the membrane's G̃_m does: both times d_muc/λ.
        "kinetic_rotation": float(k.d_muc / k.lam * k.J_m * wall.dx * wall.dy * (state.v_phi**2).sum() / 2),
        "tension": float(k.L * rows @ wall.row_width),
        "shear": float((f.G_m[1:-1] * gamma**2).sum() * wall.dx * wall.dy / 2),
        "coupling": float((f.K_coup[1:-1] * area * (state.w_m - state.w_b[:, None]) ** 2).sum() / 2),
        "beam_axial": float(k.L * axial),
        "beam_bending": float(k.mu_c_tilde * half_at_ends @ curvature**2 / 2),
        "beam_ends": float(K_a * slope_a**2 / 2 + anterior * slope_a + K_p * slope_p**2 / 2 - posterior * slope_p),
        "foundation": float(c.K_foun_pa * wall.dx * (state.w_b**2).sum() / 2),
    }


def tissue_loss(wall: WallTwin, state: State) -> dict[str, float]:
    """Power that the dampers of one wall take out, W."""
    f, area = wall.fields, node_area(wall)
    _, rate = shear_rates(wall, state)
    return {
        "shear": float((f.eta_m[1:-1] * rate**2).sum() * wall.dx * wall.dy),
        "coupling": float((f.C_coup[1:-1] * area * (state.v_m - state.v_b[:, None]) ** 2).sum()),
        "foundation": float(wall.constants.C_foun_pa_s * wall.dx * (state.v_b**2).sum()),
    }


def contact_energy(glottis: GlottisTwin, states: States) -> float:
    """Energy of the contact springs of all walls, J (½ K_col h² per node and wall; mean area of the walls)."""
    area = sum(map(node_area, glottis.walls))  # of all walls; half of it, or all, has the mean area of one
    overlap = np.maximum(-glottis.half_gap(states)[1:-1], 0.0)
    return float((glottis.contact_stiffness[1:-1] * area * overlap**2).sum() / 2)


def contact_powers(glottis: GlottisTwin, states: States) -> dict[str, float]:
    """Power that contact takes out: by its damper (of either sign) and by unequal areas of the walls, W."""
    h = glottis.half_gap(states)[1:-1]
    areas, v = [node_area(wall) for wall in glottis.walls], [state.v_m for state in states]
    mean_v = sum(v) / len(v)
    damper = np.where(h < 0, glottis.contact_damper[1:-1] * mean_v, 0.0)
    elastic = glottis.contact_stiffness[1:-1] * np.maximum(-h, 0.0)
    mismatch = (areas[0] - areas[-1]) / 2 * (v[0] - v[-1])
    return {
        "contact": float(sum((damper * a * u).sum() for a, u in zip(areas, v, strict=True))),
        "contact_mismatch": float((elastic * mismatch).sum()),
    }


def air_power(glottis: GlottisTwin, states: States, P_s: float) -> float:
    """Power that the air gives to the walls at its instantaneous pressure, W."""
    p_aero = glottis.flow(states, P_s).p_aero[1:-1]
    return -float(sum((p_aero * node_area(w) * s.v_m).sum() for w, s in zip(glottis.walls, states, strict=True)))


class Balance(NamedTuple):
    """Energies (J) and powers (W) along a motion, by term; each an array over time."""

    energy: dict[str, np.ndarray]  # stored and kinetic, summed over the walls
    loss: dict[str, np.ndarray]  # taken out
    gain: np.ndarray  # given by the air

    @property
    def total(self) -> np.ndarray:
        """Energy of all terms, J."""
        return np.sum(list(self.energy.values()), axis=0)

    def lost(self, dt: float) -> dict[str, float]:
        """Energy that each term took out from the first instant to the last, J (trapezoid rule)."""
        return {name: float(np.trapezoid(power, dx=dt)) for name, power in self.loss.items()}

    def gained(self, dt: float) -> float:
        """Energy that the air gave from the first instant to the last, J."""
        return float(np.trapezoid(self.gain, dx=dt))

    def miss(self, dt: float) -> float:
        """Change of the energy not explained by losses and air, J."""
        return float(self.total[-1] - self.total[0] + sum(self.lost(dt).values()) - self.gained(dt))


def balance(glottis: GlottisTwin, motion: Iterable[States], P_s: float = 0.0) -> Balance:
    """The terms at each instant of ``motion``, whose velocities are at the time of the displacements."""
    energies, losses, gains = [], [], []
    for states in motion:
        energy: dict[str, float] = {}
        loss: dict[str, float] = {}
        for wall, state in zip(glottis.walls, states, strict=True):
            for into, terms in ((energy, tissue_energy(wall, state)), (loss, tissue_loss(wall, state))):
                for name, value in terms.items():
                    into[name] = into.get(name, 0.0) + value
        energies.append(energy | {"contact": contact_energy(glottis, states)})
        losses.append(loss | contact_powers(glottis, states))
        gains.append(air_power(glottis, states, P_s))
    return Balance(_columns(energies), _columns(losses), np.array(gains))


def _columns(rows: Sequence[dict[str, float]]) -> dict[str, np.ndarray]:
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def centred(states: Sequence[States]) -> list[States]:
    """The motion with velocities at whole steps, from those half a step before: the mean of adjacent half steps."""
    return [
        tuple(
            here._replace(
                v_m=(here.v_m + after.v_m) / 2, v_b=(here.v_b + after.v_b) / 2, v_phi=(here.v_phi + after.v_phi) / 2
            )
            for here, after in zip(now, later, strict=True)
        )
        for now, later in zip(states[:-1], states[1:], strict=True)
    ]
