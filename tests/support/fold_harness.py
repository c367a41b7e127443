"""The fold and its twin at the same posture, and conversion of states between the two."""

from dataclasses import replace

import numpy as np

from tests.support.fold_twin import FoldTwin, State
from vfcore.fold.assemble import Fold, assemble, beam, membrane
from vfcore.fold.constants import FoldConstants
from vfcore.fold.form import RECORD
from vfcore.fold.march import TimeMarch
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
    **constants: float,
) -> tuple[Fold, FoldTwin]:
    """The same fold as assembled by Vocalis and as the twin. Angles in rad, constants SI."""
    numbers = FoldConstants(**constants)
    request = Simulation(
        convergence_angle_rad=theta_conv,
        model=Model(coupling_gradient=coupling_gradient, shear=shear),
        run=Run(nx=nx, ny=ny),
        larynx=PAPER_LARYNX.override(constants),
    )
    fold = assemble(request, coefficients(strain, a_ta, numbers), theta_g, numbers.rest_angle_rad)
    return fold, FoldTwin(strain, a_ta, theta_g, theta_conv, nx, ny, coupling_gradient, shear, numbers)


def with_constants(fold: Fold, **changes: float) -> Fold:
    """The same fold with other constants of motion (dampers, contact); its coefficients stay."""
    return replace(fold, constants=replace(fold.constants, **changes))


def put_state(march: TimeMarch, state: State) -> None:
    """Write a twin state to the buffer, with previous velocity increments 0, as in the first step of the twin."""
    inner = slice(1, -1)
    for name, value in (("w", state.w_m), ("v", state.v_m), ("v_star", state.v_m)):
        membrane(march.buffer, march.fold, name)[:, inner] = value.T
    for name, value in (("phi", state.phi), ("vphi", state.v_phi), ("vphi_star", state.v_phi)):
        membrane(march.buffer, march.fold, name)[:-1, inner] = value.T
    beam(march.buffer, march.fold, "half_min")[:] = 0.0
    for name, value in (("w_b", state.w_b), ("v_b", state.v_b), ("v_star_b", state.v_b)):
        beam(march.buffer, march.fold, name)[inner] = value


def get_state(march: TimeMarch) -> State:
    """A copy of the state in the layout of the twin."""

    def m(name):
        return membrane(march.buffer, march.fold, name)[:, 1:-1].T.copy()

    def b(name):
        return beam(march.buffer, march.fold, name)[1:-1].copy()

    return State(m("w"), b("w_b"), m("phi")[:, :-1], m("v"), b("v_b"), m("vphi")[:, :-1])


def advance(march: TimeMarch, steps: int) -> np.ndarray:
    """Advance by ``steps`` steps and record each: (steps, 7), layout.RECORD."""
    record = np.empty((steps, len(RECORD)))
    numbers = np.arange(march.steps, march.steps + steps)
    march._advance(march.buffer, march.scalars, march.pressure_at(numbers), 1, record.reshape(-1))
    march.steps += steps
    return record


def half_step_back(twin: FoldTwin, state: State, dt: float, pressure_pa: float = 0.0) -> State:
    """A state whose velocities are moved from t to t − dt/2, where the scheme of the step has them."""
    a_m, a_b, a_phi = twin.acceleration(state, pressure_pa)
    return state._replace(
        v_m=state.v_m - dt / 2 * a_m, v_b=state.v_b - dt / 2 * a_b, v_phi=state.v_phi - dt / 2 * a_phi
    )


def random_state(twin: FoldTwin, seed: int = 0, size: float = 1e-4) -> State:
    """Displacements and velocities drawn from a normal distribution of standard deviation ``size``."""
    rng = np.random.default_rng(seed)
    return State(*(size * rng.standard_normal(part.shape) for part in twin.zero_state()))
