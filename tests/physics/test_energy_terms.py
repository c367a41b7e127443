"""Energy term by term, with finite stretch, material fields and two walls: kept, lost by dampers, stored in contact."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh

from tests.support.energies import balance, centred, tissue_energy
from tests.support.glottis_twin import GlottisTwin
from tests.support.marches import MARCHES
from tests.support.patched_twin import patched
from tests.support.wall_twin import State, WallTwin
from vfcore.fold.constants import FoldConstants
from vfcore.spec.simulation import DEFAULT_STEP_S

NO_DAMPERS = FoldConstants(C_coup_pa_s_m=0.0, C_foun_pa_s=0.0, C_col_pa_s_m=0.0, eta_m_pa_s=0.0)
#: So wide open that nothing touches.
OPEN = WallTwin(0.057, 0.4, 0.5, theta_conv=0.3, nx=12, ny=6, constants=NO_DAMPERS)
CLOSE = WallTwin(0.057, 0.4, 0.02, theta_conv=0.05, nx=12, ny=6, constants=NO_DAMPERS)
SOFTER = replace(NO_DAMPERS, sigma_2_muc_pa=600.0, K_coup_max_pa_m=3e5, K_col_pa_m=4e5)
KINDS = ("linear", "finite", "finite-rotation", "finite-patch", "finite-walls")
marches = pytest.mark.parametrize("march", MARCHES.values(), ids=MARCHES)


def glottis_of(kind, wall, **constants):
    """One fold or two; ``constants`` replace those of every wall."""
    stretch, _, more = kind.partition("-")
    shear = "rotation" if more == "rotation" else "kelvin_voigt"
    wall = replace(wall, stretch=stretch, shear=shear, constants=replace(wall.constants, **constants))
    if more == "patch":
        return GlottisTwin((patched(wall),))
    if more == "walls":
        other = replace(wall, a_ta=0.1, constants=replace(SOFTER, **constants))
        return GlottisTwin((wall, patched(other)))
    return GlottisTwin((wall,))


def plucked(wall, size=1.5e-3):
    """The equilibrium plus ``size`` of the lowest mode and a twentieth of the next five; only the beam has a speed."""
    system = wall.linear_operators()
    shapes = eigh(system.K, system.M)[1][:, :6]
    surface = shapes[: wall.n * wall.ny]
    shapes = shapes / surface[np.abs(surface).argmax(axis=0), range(6)]
    q = np.linalg.solve(system.K, system.load) + size * shapes @ np.array([1, *5 * [0.05]])
    bow = np.sin(np.pi * wall.x[1:-1] / wall.k.L)
    return wall.unpack(q, 0 * q)._replace(v_b=0.3 * bow)


def thrown(wall, speed=0.3):
    """Near equilibrium, moving towards the medial plane at ``speed``, m/s."""
    system = wall.linear_operators()
    rest = wall.unpack(np.linalg.solve(system.K, system.load), np.zeros(system.load.size))
    bow, rows = np.sin(np.pi * wall.x[1:-1] / wall.k.L), np.linspace(0.7, 1.0, wall.ny)
    w_m = np.minimum(rest.w_m, wall.medial[1:-1]) - 3e-4 * np.outer(bow, rows)
    phi = np.diff(w_m, axis=1) / wall.dy if wall.shear == "rotation" else rest.phi
    return rest._replace(w_m=w_m, w_b=rest.w_b - 3e-4 * bow, phi=phi, v_m=speed * np.outer(bow, rows), v_b=speed * bow)


def moved(march, glottis, start, split, steps, pressure_pa=0.0):
    """The balance over ``steps`` default steps, each divided by ``split``; and the step, s."""
    dt = DEFAULT_STEP_S / split
    motion = march(glottis, glottis.half_step_back(start, dt, pressure_pa), pressure_pa, dt, steps * split)
    return balance(glottis, centred(motion), pressure_pa), dt


def kinetic(energies):
    return sum(part for name, part in energies.energy.items() if name.startswith("kinetic"))


@pytest.mark.parametrize("kind", KINDS)
def test_the_force_is_the_slope_of_the_energy(kind):
    """−dV/dq along random directions, q each displacement of a wall, against mass times acceleration."""
    [*_, wall] = glottis_of(kind, OPEN).walls
    rng = np.random.default_rng(1)
    state = State(*(3e-4 * rng.standard_normal(part.shape) for part in wall.zero_state()))
    state = state._replace(v_m=0 * state.v_m, v_b=0 * state.v_b, v_phi=0 * state.v_phi)
    a_m, a_b, a_phi = wall.acceleration_under(state, np.zeros((wall.nx, wall.ny)))
    mass_m = wall.fields.rho_s[1:-1] * wall.row_width * wall.dx
    mass_phi = wall.k.d_muc / wall.k.lam * wall.k.J_m * wall.dx * wall.dy
    force = {"w_m": mass_m * a_m, "w_b": wall.k.rho_l * wall.dx * a_b, "phi": mass_phi * a_phi}
    for name, expected in force.items():
        if name == "phi" and wall.shear == "kelvin_voigt":
            continue
        direction, h = rng.standard_normal(expected.shape), 1e-7
        ends = (state._replace(**{name: getattr(state, name) + sign * h * direction}) for sign in (-1, 1))
        below, above = (sum(tissue_energy(wall, end).values()) for end in ends)
        assert -(above - below) / (2 * h) == pytest.approx((expected * direction).sum(), rel=1e-6), name


def test_the_terms_add_up_to_the_energy_of_the_linear_system():
    wall = patched(replace(OPEN, shear="rotation"))
    rng = np.random.default_rng(2)
    states = [State(*(1e-4 * rng.standard_normal(part.shape) for part in wall.zero_state())) for _ in range(2)]
    apart = [sum(tissue_energy(wall, state).values()) for state in states]
    whole = [wall.linear_energy(state) for state in states]
    assert apart[1] - apart[0] == pytest.approx(whole[1] - whole[0], rel=1e-9)


@marches
@pytest.mark.parametrize("kind", KINDS)
def test_without_dampers_and_air_the_energy_oscillates_by_the_square_of_the_step(kind, march):
    glottis = glottis_of(kind, OPEN)
    start, drifts = tuple(map(plucked, glottis.walls)), []
    for split in (1, 2, 4):
        energies, _ = moved(march, glottis, start, split, 200)
        drifts.append(np.abs(energies.total - energies.total[0]).max() / kinetic(energies).max())
        assert energies.energy["contact"].max() == 0
    assert drifts[-1] < 3e-4
    assert -np.polyfit(np.log([1, 2, 4]), np.log(drifts), 1)[0] == pytest.approx(2, abs=0.1)


@marches
def test_the_energy_of_the_stretch_is_a_large_part_of_what_is_kept(march):
    """The tension term with the nominal tension alone would miss the total by far more than the drift."""
    glottis = glottis_of("finite", OPEN)
    [wall] = glottis.walls
    dt = DEFAULT_STEP_S / 4
    start = glottis.half_step_back((plucked(wall),), dt)
    motion = centred(march(glottis, start, 0.0, dt, 800))
    finite = balance(glottis, motion)
    nominal = balance(GlottisTwin((replace(wall, stretch="linear"),)), motion)
    swing = kinetic(finite).max()
    assert np.ptp(finite.total) < 2e-3 * swing
    assert np.ptp(nominal.total) > 0.05 * swing


@marches
@pytest.mark.parametrize("kind", ["finite-rotation", "finite-walls"])
@pytest.mark.parametrize(
    ("term", "constant"),
    [("shear", {"eta_m_pa_s": 1.0}), ("coupling", {"C_coup_pa_s_m": 40.0}), ("foundation", {"C_foun_pa_s": 10.0})],
)
def test_one_damper_takes_what_its_term_dissipates(term, constant, kind, march):
    glottis = glottis_of(kind, OPEN, **constant)
    start, misses = tuple(map(plucked, glottis.walls)), []
    for split in (4, 8):
        energies, dt = moved(march, glottis, start, split, 200)
        scale, lost = kinetic(energies).max(), energies.lost(dt)
        assert lost[term] > 0.01 * scale
        assert all(value == 0 for name, value in lost.items() if name != term)
        misses.append(abs(energies.miss(dt)) / scale)
    assert misses[0] < 5e-4 and misses[1] < misses[0] / 2.5


@marches
@pytest.mark.parametrize("kind", KINDS)
def test_contact_gives_back_what_it_stores(kind, march):
    """The folds are thrown together and part again; no damper, no air."""
    glottis = glottis_of(kind, CLOSE)
    start, changes = tuple(map(thrown, glottis.walls)), []
    for split in (2, 8):
        energies, _ = moved(march, glottis, start, split, 160)
        stored = energies.energy["contact"]
        scale = kinetic(energies)[0]
        assert stored.max() > 0.05 * scale
        first = np.flatnonzero(stored)[0]
        assert (stored[first:] == 0).any(), "the folds part again"
        changes.append(np.abs(energies.total - energies.total[0]).max() / scale)
    assert changes[0] < 0.03
    assert changes[1] < changes[0] / 10


@marches
@pytest.mark.parametrize("kind", ["finite", "finite-walls"])
def test_the_contact_damper_takes_what_the_bounce_loses(kind, march):
    glottis = glottis_of(kind, CLOSE, C_col_pa_s_m=100.0)
    energies, dt = moved(march, glottis, tuple(map(thrown, glottis.walls)), 16, 160)
    scale, lost = kinetic(energies)[0], energies.lost(dt)
    assert lost["contact"] > 0.01 * scale
    assert abs(energies.miss(dt)) < 5e-4 * scale


@marches
def test_walls_of_unequal_area_exchange_energy_only_as_their_areas_differ(march):
    """The same pressure on unequal areas has no potential: the balance closes with that term and not without it."""
    left = replace(CLOSE, stretch="finite")
    glottis = GlottisTwin((left, replace(left, strain=-0.1, theta_g=0.0)))
    energies, dt = moved(march, glottis, tuple(map(thrown, glottis.walls)), 16, 160)
    scale = kinetic(energies)[0]
    exchanged = np.abs(np.cumsum(energies.loss["contact_mismatch"]) * dt).max()
    assert abs(energies.miss(dt)) < 0.02 * exchanged
    assert exchanged > 1e-3 * scale


@marches
@pytest.mark.parametrize("kind", ["finite", "finite-walls"])
def test_a_voice_gains_from_the_air_what_its_dampers_lose(kind, march):
    """From onset through contact to full swing at 1000 Pa; the miss falls by the square of the step."""
    wall = WallTwin(0.057, 0.4, 0.0, nx=12, ny=6)
    glottis = glottis_of(kind, wall)
    if kind == "finite-walls":
        glottis = GlottisTwin((glottis.walls[0], patched(glottis.walls[0], 0.5)))
    start, misses = glottis.initial_states(), []
    for split in (2, 8):
        energies, dt = moved(march, glottis, start, split, 700, 1000.0)
        assert energies.energy["contact"].max() > 1e-7
        misses.append(abs(energies.miss(dt)) / energies.gained(dt))
    assert misses[0] < 0.06
    assert misses[1] < misses[0] / 10
