"""The product and its twin at the same posture, and conversion of states between the two."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from tests.support.fold_twin import FoldTwin, State
from tests.support.glottis_twin import GlottisTwin, States
from tests.support.wall_twin import WallTwin
from vfcore.fold import assemble
from vfcore.fold.assemble import Fold, Glottis
from vfcore.fold.constants import FoldConstants
from vfcore.fold.march import TimeMarch
from vfcore.fold.material import FIELDS
from vfcore.larynx.tissue.coefficients import coefficients
from vfcore.spec.larynx import PAPER_LARYNX
from vfcore.spec.simulation import Model, Run, Simulation

MODAL = {"strain": 0.057, "a_ta": 0.4, "theta_g": 0.0}
#: So wide open that nothing touches; without lung pressure every equation is linear.
WIDE_OPEN = {"strain": 0.057, "a_ta": 0.4, "theta_g": 0.5, "theta_conv": 0.3}
NO_DAMPERS = {"C_coup_pa_s_m": 0.0, "C_foun_pa_s": 0.0, "C_col_pa_s_m": 0.0, "eta_m_pa_s": 0.0}
SHEARS = ("kelvin_voigt", "rotation")


def product_and_twin(
    strain: float,
    a_ta: float,
    theta_g: float,
    theta_conv: float = 0.02,
    nx: int = 20,
    ny: int = 10,
    coupling_gradient: str = "inferior_stiff",
    shear: str = "kelvin_voigt",
    stretch: str = "linear",
    **constants: float,
) -> tuple[Glottis, FoldTwin]:
    """The same fold, with its mirror image, as assembled by Vocalis and as the twin. Angles in rad, constants SI."""
    numbers = FoldConstants(**constants)
    twin = FoldTwin(strain, a_ta, theta_g, theta_conv, nx, ny, coupling_gradient, shear, numbers, stretch)
    return Glottis((fold_of(twin),)), twin


def fold_of(wall: WallTwin) -> Fold:
    """The fold of a twin as Vocalis assembles it; fields given to the twin replace those of the uniform fold."""
    request = Simulation(
        convergence_angle_rad=wall.theta_conv,
        model=Model(coupling_gradient=wall.coupling_gradient, shear=wall.shear, stretch=wall.stretch),
        run=Run(nx=wall.nx, ny=wall.ny),
        larynx=replace(PAPER_LARYNX, fold=wall.constants),
    )
    request = replace(request, activation=replace(request.activation, ta=wall.a_ta))
    c = coefficients(wall.strain, wall.a_ta, wall.constants)
    fold = assemble.assemble(request, wall.strain, c, wall.theta_g, wall.constants.rest_angle_rad)
    return replace(fold, fields=fields_of(wall), patched=True) if wall.given else fold


def fields_of(wall: WallTwin) -> np.ndarray:
    """The material of a twin in the layout of Vocalis, (9, ny, nx): shear over dy², idle ends of intervals 0."""
    given, fields = wall.fields, np.zeros((len(FIELDS), wall.ny, wall.nx))
    named = dict(zip(FIELDS, fields, strict=True))
    for name, values in (
        ("G", given.medial),
        ("mass", given.rho_s),
        ("coupling", given.K_coup),
        ("coupling_damper", given.C_coup),
        ("contact", given.K_col),
        ("contact_damper", given.C_col),
    ):
        named[name][:] = values.T
    named["tension_share"][:, :-1] = given.tau.T
    named["shear"][:-1], named["shear_viscosity"][:-1] = given.G_m.T / wall.dy**2, given.eta_m.T / wall.dy**2
    return fields


def product_of(twin: GlottisTwin) -> Glottis:
    """The glottis of a twin as Vocalis assembles it."""
    return Glottis(tuple(map(fold_of, twin.walls)))


def membrane(march: TimeMarch, name: str = "w", side: int = 0) -> np.ndarray:
    """A view (ny, nx) of a field of a wall, ends included."""
    return assemble.membranes(march.buffer, march.layout, name, side)[:, :, 0]


def beam(march: TimeMarch, name: str = "w_b", side: int = 0) -> np.ndarray:
    """A view (nx,) of a line of a wall, ends included."""
    return assemble.beams(march.buffer, march.layout, name, side)[:, 0]


def put_states(march: TimeMarch, states: Sequence[State]) -> None:
    """Write the twin's states of all walls to the buffer, with previous velocity increments 0, as the twin starts."""
    inner = slice(1, -1)
    for side, state in enumerate(states):
        for name, value in (("w", state.w_m), ("v", state.v_m), ("v_star", state.v_m)):
            membrane(march, name, side)[:, inner] = value.T
        if march.form.rotation:
            for name, value in (("phi", state.phi), ("vphi", state.v_phi), ("vphi_star", state.v_phi)):
                membrane(march, name, side)[:-1, inner] = value.T
        for name, value in (("w_b", state.w_b), ("v_b", state.v_b), ("v_star_b", state.v_b)):
            beam(march, name, side)[inner] = value
    beam(march, "half_min")[:] = 0.0


def get_states(march: TimeMarch) -> States:
    """Copies of the states of all walls in the layout of the twin."""
    return tuple(_state(march, side) for side in range(march.form.walls))


def _state(march: TimeMarch, side: int) -> State:
    form = march.form

    def m(name):
        return membrane(march, name, side)[:, 1:-1].T.copy()

    def b(name):
        return beam(march, name, side)[1:-1].copy()

    def rotation(name):
        return m(name)[:, :-1] if form.rotation else np.zeros((form.nx - 2, form.ny - 1))

    return State(m("w"), b("w_b"), rotation("phi"), m("v"), b("v_b"), rotation("vphi"))


def put_state(march: TimeMarch, state: State) -> None:
    """``put_states`` of a fold with its mirror image."""
    put_states(march, [state])


def get_state(march: TimeMarch) -> State:
    """``get_states`` of a fold with its mirror image."""
    [state] = get_states(march)
    return state


def advance(march: TimeMarch, steps: int) -> np.ndarray:
    """Advance by ``steps`` steps and record each: (steps, columns), march.form.record."""
    record = np.empty((steps, len(march.form.record)))
    march.advance(march.pressure_at(np.arange(march.steps, march.steps + steps)), 1, record)
    march.steps += steps
    return record


def half_step_back(twin: FoldTwin, state: State, dt: float, pressure_pa: float = 0.0) -> State:
    """A state whose velocities are moved from t to t − dt/2, where the scheme of the step has them."""
    [back] = twin.glottis.half_step_back((state,), dt, pressure_pa)
    return back


def random_state(twin: FoldTwin, seed: int = 0, size: float = 1e-4) -> State:
    """Displacements and velocities drawn from a normal distribution of standard deviation ``size``."""
    rng = np.random.default_rng(seed)
    return State(*(size * rng.standard_normal(part.shape) for part in twin.zero_state()))
