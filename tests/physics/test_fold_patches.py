"""Material that varies over the surface: each field acts where it is, with the force that the equations give."""

import numpy as np
import pytest

from tests.support.fold_twin import FoldTwin
from tests.support.patched_twin import patch_shape, patched
from tests.support.wall_twin import Fields
from vfcore.spec.simulation import DEFAULT_STEP_S

SHEARS = ("kelvin_voigt", "rotation")
MODAL = FoldTwin(0.057, 0.4, 0.0, nx=12, ny=6)


def random_state(fold, seed=0, size=1e-4):
    rng = np.random.default_rng(seed)
    zero = fold.zero_state()
    return type(zero)(*(size * rng.standard_normal(part.shape) for part in zero))


def random_fields(fold, seed=0):
    """Every field times a number between 0.5 and 2, drawn for each node."""
    rng = np.random.default_rng(seed)
    return {name: field * 2.0 ** rng.uniform(-1, 1, field.shape) for name, field in fold.fields._asdict().items()}


def test_uniform_fields_are_the_fold_without_fields():
    filled = MODAL.with_fields(**MODAL.fields._asdict())
    runs = [fold.run(fold.initial_state(), 1000.0, DEFAULT_STEP_S, 300) for fold in (MODAL, filled)]
    assert (runs[0].final.w_m == runs[1].final.w_m).all()


@pytest.mark.parametrize("shear", SHEARS)
def test_forces_at_the_nodes_are_those_of_the_energies_between_them(shear):
    """The matrices are built link by link from energies, the accelerations from differences of fluxes."""
    fold = FoldTwin(0.1, 0.7, 0.05, nx=9, ny=5, shear=shear)
    fold = fold.with_fields(**random_fields(fold))
    state = random_state(fold)
    system, (q, v) = fold.linear_operators(), fold.pack(state)
    expected = fold.unpack((system.load - system.K @ q - system.C @ v) / np.diag(system.M), v)
    for got, want in zip(fold.acceleration(state, 0.0, contact=False), expected[:3], strict=True):
        assert got == pytest.approx(want, rel=1e-9, abs=1e-9 * np.abs(want).max())


@pytest.mark.parametrize("name", Fields._fields)
def test_a_field_acts_only_beside_the_place_where_it_differs(name):
    """Doubled at one place of the third row of nodes (or in the interval after it), membrane nodes there change."""
    fold = MODAL
    changed = getattr(fold.fields, name).copy()
    changed[4, 2] *= 2
    state = random_state(fold)
    state = state._replace(w_m=state.w_m + fold.medial[1:-1])  # about half of the nodes touch
    state.w_m[3, 2] = fold.medial[4, 2] + 3e-4
    if name == "medial":
        state.w_m[3, 2] = fold.medial[4, 2] + 1e-6  # the doubled one is beyond
        changed[4, 2] = fold.medial[4, 2] - 1e-4
    before = fold.acceleration(state, 0.0)[0]
    after = fold.with_fields(**{name: changed}).acceleration(state, 0.0)[0]
    expected = {"tau": {(3, 2), (4, 2)}, "G_m": {(3, 2), (3, 3)}, "eta_m": {(3, 2), (3, 3)}}.get(name, {(3, 2)})
    assert set(zip(*map(tuple, np.nonzero(after - before)), strict=True)) == expected


def test_a_node_of_twice_the_mass_has_half_the_acceleration():
    rho_s = MODAL.fields.rho_s.copy()
    rho_s[5, 3] *= 2
    state = random_state(MODAL)
    before, after = (fold.acceleration(state, 800.0)[0] for fold in (MODAL, MODAL.with_fields(rho_s=rho_s)))
    ratio = after / before
    assert ratio[4, 3] == pytest.approx(0.5, rel=1e-12)
    ratio[4, 3] = 1.0
    assert (ratio == 1.0).all()


def test_a_bump_touches_first_and_narrows_the_flow():
    fold = FoldTwin(0.057, 0.4, 0.05)
    with_bump = patched(fold, 0.0, bump_m=6e-4)
    flat = fold.flow(fold.zero_state().w_m, 1000.0)
    raised = with_bump.flow(fold.zero_state().w_m, 1000.0)
    assert raised.Q_g < 0.95 * flat.Q_g
    w_m = fold.medial[1:-1] - 5e-4
    pressure = with_bump.contact_pressure(w_m, 0 * w_m)[1:-1]
    assert (fold.contact_pressure(w_m, 0 * w_m) == 0).all()
    assert ((pressure > 0) == (patch_shape(fold)[1:-1] > 5 / 6)).all() and pressure.any()


def test_the_coupling_pulls_the_beam_with_the_traction_of_every_row():
    fold = MODAL.with_fields(**random_fields(MODAL))
    state = MODAL.zero_state()._replace(w_m=random_state(MODAL).w_m)
    pulled = fold.acceleration(state, 0.0, contact=False)[1] - fold.beam_load
    expected = [
        sum(fold.fields.K_coup[i + 1, j] * state.w_m[i, j] * fold.row_width[j] for j in range(fold.ny)) / fold.k.rho_l
        for i in range(fold.n)
    ]
    assert pulled == pytest.approx(expected, rel=1e-9)


def test_a_field_of_the_wrong_shape_is_refused():
    with pytest.raises(ValueError, match="tau has the shape"):
        MODAL.with_fields(tau=np.ones((12, 6)))


def test_a_heavy_patch_lowers_the_lowest_mode_and_a_tense_one_raises_it():
    modes = {
        name: MODAL.with_fields(**{name: getattr(MODAL.fields, name) * 1.5}).mode_frequencies(1)[0]
        for name in ("rho_s", "tau")
    }
    assert modes["rho_s"] < MODAL.mode_frequencies(1)[0] < modes["tau"]
