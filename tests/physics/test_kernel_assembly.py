"""The compiled assembler against the numbers that the formulas give in numpy, and the buffers that it fills."""

from dataclasses import replace

import numpy as np
import pytest

from tests.support import stretch_twin
from tests.support.fold_harness import fields_of
from tests.support.wall_twin import WallTwin
from vfcore.errors import ParameterError
from vfcore.fold.assemble import Glottis, beams, empty_buffer, fill, membranes, new_buffer
from vfcore.fold.form import StepForm
from vfcore.fold.layout import FACTORS, LAW, LINES, PATCHED, PATCHED_PAIR, SHARED_LINES, layout_of
from vfcore.fold.march import TimeMarch
from vfcore.fold.material import FIELDS
from vfcore.fold.terms import GLOTTIS_NUMBERS, WALL_NUMBERS
from vfcore.fold.terms.tension import axial, stretched
from vfcore.kernels.banded import factor, invert
from vfcore.runs.gesture.glide import GlidingGlottis, GlottisSpec
from vfcore.runs.setup import prepare
from vfcore.spec.larynx import PAPER_LARYNX
from vfcore.spec.lesions import Lesion
from vfcore.spec.request import resolve
from vfcore.spec.simulation import DEFAULT_STEP_S, Activation, Model, PostureOverride, Run, Simulation

pytestmark = pytest.mark.kernel
START = Simulation(run=Run(nx=8, ny=4))
LESIONS = (
    Lesion(x=0.4, y=0.3, length_mm=9.0, width_mm=4.0, height_mm=0.4, mass_ratio=2.0, stiffness_ratio=3.0),
    Lesion(x=0.6, y=0.7, length_mm=6.0, width_mm=5.0, height_mm=-0.2, stiffness_ratio=0.5, viscosity_ratio=4.0),
)
REQUESTS = {
    "muscles": Simulation(run=START.run, activation=Activation(ta=0.9, ct=0.1, lca=0.3, ia=0.2, pca=0.5)),
    "diverging": Simulation(run=START.run, activation=Activation(ct=1.0), convergence_angle_rad=-0.01),
    "text literal": Simulation(run=START.run, model=Model(variant="text_literal")),
    "rotation": Simulation(run=START.run, model=Model(shear="rotation", coupling_gradient="superior_stiff")),
    "posture": Simulation(run=START.run, posture=PostureOverride(0.1, 0.05, 0.2), convergence_angle_rad=0.1),
    "constants": Simulation(
        run=START.run, larynx=PAPER_LARYNX.override({"L_0_m": 0.01, "K_r_a_n_m": 0.5, "K_coup_min_pa_m": 6e5})
    ),
    "finite": Simulation(run=START.run, model=Model(stretch="finite"), activation=Activation(ta=0.7)),
    "lesions": Simulation(run=START.run, lesions=LESIONS),
}
requests = pytest.mark.parametrize("request_", REQUESTS.values(), ids=REQUESTS)


def twin_of(request: Simulation) -> WallTwin:
    """The wall of a request as the twin has it, its lesions applied by ``with_lesions``."""
    ready, rest = prepare(request), request.constants.rest_angle_rad
    if request.posture:
        rest = request.posture.rest_angle_rad
    wall = WallTwin(
        ready.posture.strain,
        request.activation.ta,
        ready.posture.glottal_half_angle_rad,
        request.convergence_angle_rad,
        request.run.nx,
        request.run.ny,
        request.model.coupling_gradient,
        request.model.shear,
        replace(request.constants, rest_angle_rad=rest),
        request.model.stretch,
    )
    return with_lesions(wall, request.lesions)


def patch(wall: WallTwin, one: Lesion, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """s of a lesion at ``x`` and ``y``, (len(x), len(y)), vfcore/fold/material.py."""
    along = (x[:, None] - one.x * wall.k.L) / (one.length_mm / 2e3)
    across = (y[None, :] - one.y * wall.k.b) / (one.width_mm / 2e3)
    r = np.hypot(along, across)
    return np.where(r < 1, np.cos(np.pi * r / 2) ** 2, 0.0)


def with_lesions(wall: WallTwin, lesions) -> WallTwin:
    """Every field times the ratio of each lesion, at nodes and half way between them."""
    between_x, between_y = ((z[1:] + z[:-1]) / 2 for z in (wall.x, wall.y))
    for one in lesions:
        nodes, f = patch(wall, one, wall.x, wall.y), wall.fields
        along_x, along_y = patch(wall, one, between_x, wall.y), patch(wall, one, wall.x, between_y)
        stiff, viscous = one.stiffness_ratio - 1, one.viscosity_ratio - 1
        wall = wall.with_fields(
            rho_s=f.rho_s * (1 + (one.mass_ratio - 1) * nodes),
            tau=f.tau * (1 + stiff * along_x),
            G_m=f.G_m * (1 + stiff * along_y),
            eta_m=f.eta_m * (1 + viscous * along_y),
            K_coup=f.K_coup * (1 + stiff * nodes),
            C_coup=f.C_coup * (1 + viscous * nodes),
            K_col=f.K_col * (1 + stiff * nodes),
            C_col=f.C_col * (1 + viscous * nodes),
            medial=f.medial - 1e-3 * one.height_mm * nodes,
        )
    return wall


def same(found, wanted, name):
    """Tolerance 1e-12 of the largest number: rounding, in another order of operations."""
    np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-12 * np.abs(wanted).max() + 1e-300, err_msg=name)


@requests
def test_material_and_beam_are_those_of_the_formulas(request_):
    [fold], twin = prepare(request_).glottis.walls, twin_of(request_)
    wanted = dict(zip(FIELDS, fields_of(twin), strict=True))
    for name, used in wanted.items():
        cut = {"tension_share": np.s_[:, :-1], "shear": np.s_[:-1], "shear_viscosity": np.s_[:-1]}.get(name, np.s_[:])
        same(fold.field(name)[cut], used[cut], name)
    same(fold.beam_matrix_n_m2, twin.beam_operator * twin.k.rho_l, "beam")
    same(fold.beam_load_n_m, twin.beam_load * twin.k.rho_l, "load")
    assert fold.patched == bool(request_.lesions) and fold.finite == (request_.model.stretch == "finite")


@requests
def test_numbers_of_the_step_are_those_of_the_formulas(request_):
    [fold], twin = prepare(request_).glottis.walls, twin_of(request_)
    k, c, dx, dy = twin.k, twin.constants, twin.dx, twin.dy
    wanted = {
        "dy": dy,
        "inv_beam_density": 1 / k.rho_l,
        "T_over_dx2": k.T_m_tilde / dx**2,
        "stretch_gain": k.lam / 2 / ((twin.nx - 1) * dx**2),
        "beam_gain": k.lam / 2 / ((twin.nx - 1) * dx**2),
        "G_shear_over_dy2": k.G_m_tilde / dy**2,
        "eta_shear_over_dy2": k.eta_m_tilde / dy**2,
        "inv_rotation_inertia": 1 / k.J_m,
        "G_rotation": c.G_m_pa,
        "eta_rotation": c.eta_m_pa_s,
        "rotation_share": k.lam * dy**2 / k.d_muc,
        "C_coup": c.C_coup_pa_s_m,
        "K_foun": c.K_foun_pa,
        "C_foun": c.C_foun_pa_s,
    }
    assert wanted == pytest.approx({name: fold.number(name) for name in wanted}, rel=1e-12)


@requests
@pytest.mark.parametrize("e", [0.0, 0.01, 0.1, 0.3])
def test_the_tensions_follow_the_stress_of_the_paper_at_the_stretched_strain(request_, e):
    [fold], twin = prepare(request_).glottis.walls, twin_of(request_)
    law = [fold.number(name) for name in ("T_A", "T_B", "T_C", "T_z", "T_alpha")]
    membrane = stretch_twin.membrane_tension(twin.constants, twin.k, twin.strain + e) / twin.dx**2
    assert stretched(e, *law) == pytest.approx(membrane, rel=1e-9)
    begin = WALL_NUMBERS.index("beam_gain") + 1
    beam = stretch_twin.beam_force(twin.constants, twin.k, twin.a_ta, twin.strain + e) - twin.k.N_b_tilde
    found = axial(e, *fold.numbers[begin : begin + 11])
    assert found == pytest.approx(beam / twin.dx**2, rel=1e-9, abs=1e-9 * twin.k.N_b_tilde / twin.dx**2)


def glottises(request: Simulation) -> list[Glottis]:
    """One glottis per vector element, each of another length, made of one wall or of two."""
    strains = 0.02 + 0.02 * np.arange(8)
    changed = [replace(request, posture=PostureOverride(float(strain), 0.02)) for strain in strains]
    return [prepare(one).glottis for one in changed]


FORMS = {
    "plain": START,
    "rotation": REQUESTS["rotation"],
    "finite": REQUESTS["finite"],
    "lesions": REQUESTS["lesions"],
    "walls": resolve({"run": {"nx": 8, "ny": 4}, "right": {"activation": {"ta": 0.9}}, "model": {"stretch": "finite"}}),
}


def fixed(buffer, form: StepForm, place: int = 0) -> dict[str, np.ndarray]:
    """Everything fixed that a buffer holds of a glottis, by name and wall."""
    layout, found = layout_of(form), {}
    fields = ("G", *(PATCHED if form.patched else ()))
    for side in range(form.walls):
        for name in fields:
            found[name, side] = membranes(buffer, layout, name, side)[:, :, place]
        for name in LINES:
            found[name, side] = beams(buffer, layout, name, side)[:, place]
        counted = {"wall_numbers": len(WALL_NUMBERS), "K_coup": form.ny}
        counted |= dict.fromkeys(LAW, form.ny + 2) if form.finite else {}
        for name, count in counted.items():
            at = layout.at(name, side)
            found[name, side] = buffer[at : at + count * form.glottises].reshape(count, form.glottises)[:, place]
    for name in PATCHED_PAIR if form.patched else ():
        found[name, 0] = membranes(buffer, layout, name)[:, :, place]
    for name in SHARED_LINES:
        found[name, 0] = beams(buffer, layout, name)[:, place]
    at = layout.at("numbers")
    count = len(GLOTTIS_NUMBERS)
    found["numbers", 0] = buffer[at : at + count * form.glottises].reshape(count, form.glottises)[:, place]
    return found


@pytest.mark.parametrize("kind", FORMS)
def test_buffers_of_one_and_of_several_glottises_hold_the_same_numbers(kind):
    several = glottises(FORMS[kind])
    form = several[0].form(many=True)
    layout, buffer = layout_of(form), empty_buffer(layout_of(form))
    for place, glottis in enumerate(several):
        before = buffer.copy()
        fill(buffer, layout, place, glottis, DEFAULT_STEP_S)
        changed = np.flatnonzero(buffer != before)
        assert (changed >= layout.fixed).all() and (changed % form.glottises == place).all()
    for place, glottis in enumerate(several):
        alone = glottis.form()
        wanted, found = (
            fixed(new_buffer(glottis, alone, DEFAULT_STEP_S), alone),
            fixed(buffer, form, place),
        )
        assert wanted.keys() == found.keys()
        for name, values in wanted.items():
            assert np.array_equal(values, found[name]), name
    lengths = {tuple(fixed(buffer, form, place)["width", 0]) for place in range(form.glottises)}
    assert len(lengths) == form.glottises, "the glottises differ"


@pytest.mark.parametrize("kind", ["plain", "walls"])
def test_the_implicit_matrix_of_the_beam_is_that_of_the_trapezoidal_rule(kind):
    several = glottises(FORMS[kind])
    for side, wall in enumerate(several[0].walls):
        n = wall.nx - 2
        implicit = np.eye(n) - DEFAULT_STEP_S**2 / 4 * wall.beam_matrix_n_m2 / wall.coefficients.beam_density_kg_m
        form = several[0].form()
        layout, buffer = layout_of(form), new_buffer(several[0], form, DEFAULT_STEP_S)
        at = layout.at("beam_inverse", side)
        inverse = buffer[at : at + n * layout.worked].reshape(n, -1)[:, :n]
        same(inverse, np.linalg.inv(implicit), "inverse")
        form = several[0].form(many=True)
        layout, buffer = layout_of(form), empty_buffer(layout_of(form))
        fill(buffer, layout, 2, several[0], DEFAULT_STEP_S)
        inv_D, a, c = (beams(buffer, layout, name, side)[1:-1, 2] for name in FACTORS)
        lower = np.eye(n) + np.diag(a[1:], -1) + np.diag(c[2:], -2)
        same(lower @ np.diag(1 / inv_D) @ lower.T, implicit, "factors")


def test_the_banded_inverse_is_the_inverse():
    """Tolerance 1e-13 of the largest number: the matrix is well conditioned."""
    rng = np.random.default_rng(3)
    for n in (4, 5, 18):
        first, second, diagonal = -0.7, 0.2, rng.uniform(2.0, 4.0, n)
        matrix = np.diag(diagonal)
        for shift, value in ((1, first), (2, second)):
            matrix += value * (np.eye(n, k=shift) + np.eye(n, k=-shift))
        found = np.full((n, n + 3), 7.0)
        D, (a, c) = diagonal.copy(), np.empty((2, n))
        factor(D, first, second, a, c)
        invert(D, a, c, found.reshape(-1), n + 3)
        right = np.linalg.inv(matrix)
        np.testing.assert_allclose(found[:, :n], right, rtol=0, atol=1e-13 * np.abs(right).max())
        assert (found[:, n:] == 7.0).all(), "idle columns must not change"


def test_a_target_without_stiffness_or_with_too_short_a_step_is_refused_and_the_fold_continues():
    ready = prepare(START)
    march = TimeMarch(ready.glottis, DEFAULT_STEP_S, 800.0)
    march.start(0, None)
    gliding = GlidingGlottis(march, GlottisSpec((START,), ready.postures))
    slack = PAPER_LARYNX.override({"sigma_1_muc_pa": 0.0, "sigma_2_muc_pa": 0.0})
    with pytest.raises(ParameterError, match="no stiffness left"):
        gliding.advance(GlottisSpec((Simulation(run=START.run, larynx=slack),), ready.postures), 800.0, 45)
    stiff = PAPER_LARYNX.override({"C_col_pa_s_m": 1e5})
    with pytest.raises(ParameterError, match="need a shorter step"):
        gliding.advance(GlottisSpec((Simulation(run=START.run, larynx=stiff),), ready.postures), 800.0, 45)
    assert np.isfinite(gliding.advance(GlottisSpec((START,), ready.postures), 900.0, 45)[:, :2]).all()
