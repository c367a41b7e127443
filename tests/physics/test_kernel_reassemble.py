"""Compiled re-assembly at a new posture against the fold that Python assembles for the same posture."""

import numpy as np
import pytest

from vfcore.errors import ParameterError
from vfcore.fold import assemble
from vfcore.fold.march import TimeMarch
from vfcore.fold.stability import SAFETY, longest_stable_step_s
from vfcore.kernels.banded import factor, invert
from vfcore.kernels.layout import SCALARS, Layout
from vfcore.kernels.reassemble import reassemble_kernel
from vfcore.runs.gesture.glide import FoldSpec, GlidingFold, packed
from vfcore.runs.setup import prepare
from vfcore.spec.larynx import PAPER_LARYNX
from vfcore.spec.simulation import DEFAULT_STEP_S, Activation, Model, PostureOverride, Run, Simulation

pytestmark = pytest.mark.kernel
START = Simulation(run=Run(nx=8, ny=4))


def filled(request: Simulation) -> tuple[np.ndarray, np.ndarray, float]:
    """Buffer, scalars and longest step of the kernel for a request, written over those of START."""
    ready, at_first = prepare(request), prepare(START)
    buffer = assemble.new_buffer(at_first.fold, DEFAULT_STEP_S)
    scalars, work = np.empty(len(SCALARS)), np.empty(3 * request.run.nx)
    rest_angle = request.posture.rest_angle_rad if request.posture else request.constants.rest_angle_rad
    inferior_stiff = request.model.coupling_gradient == "inferior_stiff"
    longest_s = reassemble_kernel(request.run.nx, request.run.ny, ready.fold.rotation)(
        ready.posture.strain,
        request.activation.ta,
        ready.posture.glottal_half_angle_rad,
        rest_angle,
        request.convergence_angle_rad,
        inferior_stiff,
        DEFAULT_STEP_S,
        packed(request.constants),
        buffer,
        scalars,
        work,
    )
    return buffer, scalars, longest_s


@pytest.mark.parametrize(
    "request_",
    [
        Simulation(run=START.run, activation=Activation(ta=0.9, ct=0.1, lca=0.3, ia=0.2, pca=0.5)),
        Simulation(run=START.run, activation=Activation(ct=1.0), convergence_angle_rad=-0.01),
        Simulation(run=START.run, model=Model(variant="text_literal")),
        Simulation(run=START.run, model=Model(shear="rotation", coupling_gradient="superior_stiff")),
        Simulation(run=START.run, posture=PostureOverride(0.1, 0.05, 0.2), convergence_angle_rad=0.1),
        Simulation(
            run=START.run, larynx=PAPER_LARYNX.override({"L_0_m": 0.01, "K_r_a_n_m": 0.5, "K_coup_min_pa_m": 6e5})
        ),
    ],
)
def test_the_numbers_are_those_of_the_assembled_fold(request_):
    """Tolerance 1e-12 of the largest number of each field: rounding, in another order of operations."""
    fold, layout = prepare(request_).fold, Layout(request_.run.nx, request_.run.ny)
    buffer, scalars, longest_s = filled(request_)
    wanted = assemble.new_buffer(fold, DEFAULT_STEP_S)
    views, expected = (assemble.fixed(whole, layout, 0) for whole in (buffer, wanted))
    for name, found, right in zip(views._fields, views, expected, strict=True):
        np.testing.assert_allclose(found, right, rtol=0, atol=1e-12 * np.abs(right).max(), err_msg=name)
    untouched = np.ones(layout.size, bool)
    for view in assemble.fixed(untouched, layout, 0):
        view[...] = False
    assert np.array_equal(buffer[untouched], wanted[untouched]), "and nothing else may be written"
    np.testing.assert_allclose(scalars, assemble.scalars(fold, DEFAULT_STEP_S), rtol=1e-12)
    assert SAFETY * longest_s == pytest.approx(longest_stable_step_s(fold), rel=1e-12)


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
    march = TimeMarch(ready.fold, DEFAULT_STEP_S, 800.0)
    march.start_flat()
    gliding = GlidingFold(march, FoldSpec(START, ready.posture))
    slack = PAPER_LARYNX.override({"sigma_1_muc_pa": 0.0, "sigma_2_muc_pa": 0.0})
    with pytest.raises(ParameterError, match="no stiffness left"):
        gliding.advance(FoldSpec(Simulation(run=START.run, larynx=slack), ready.posture), 800.0, 45)
    stiff = PAPER_LARYNX.override({"C_col_pa_s_m": 1e5})
    with pytest.raises(ParameterError, match="need a shorter step"):
        gliding.advance(FoldSpec(Simulation(run=START.run, larynx=stiff), ready.posture), 800.0, 45)
    assert np.isfinite(gliding.advance(FoldSpec(START, ready.posture), 900.0, 45)[:, :2]).all()
