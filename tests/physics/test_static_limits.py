"""Static shapes with known solutions: no load, rigid coupling, no coupling, hard contact."""

from dataclasses import replace

import numpy as np
import pytest

import vfcore.fold.statics
from tests.support.fold_harness import MODAL, product_and_twin
from vfcore.errors import StaticShapeError
from vfcore.fold.assemble import Glottis
from vfcore.fold.statics import static_shapes_of
from vfcore.fold.terms.beam import BANDS

OPEN = {"strain": 0.057, "a_ta": 0.4, "theta_g": 0.4, "theta_conv": 0.2}


def test_a_fold_without_load_stays_flat():
    glottis, _ = product_and_twin(**OPEN)
    [fold] = glottis.walls
    unloaded = replace(fold, bands=np.where(np.char.startswith(BANDS, "load"), 0.0, fold.bands))
    [shape] = static_shapes_of(Glottis((unloaded,)))
    assert fold.beam_load_n_m.any()
    assert not shape.w_m.any() and not shape.w_b.any()


def test_without_coupling_the_beam_bends_alone():
    glottis, _ = product_and_twin(**OPEN, K_coup_min_pa_m=0.0, K_coup_max_pa_m=0.0, K_foun_pa=0.0)
    [fold], [shape] = glottis.walls, static_shapes_of(glottis)
    assert not shape.w_m.any()
    assert shape.w_b[1:-1] == pytest.approx(np.linalg.solve(-fold.beam_matrix_n_m2, fold.beam_load_n_m), rel=1e-9)


def test_a_rigid_coupling_moves_membrane_and_beam_as_one():
    glottis, _ = product_and_twin(**OPEN, K_coup_min_pa_m=1e8, K_coup_max_pa_m=1e8)
    [shape] = static_shapes_of(glottis)
    assert np.abs(shape.w_m - shape.w_b).max() < 1e-2 * np.abs(shape.w_b).max()
    assert np.abs(shape.w_b).max() > 1e-5


def test_a_stiffer_contact_lets_the_folds_overlap_less():
    overlaps = []
    for stiffness in (1e6, 1e7, 1e9):
        shape = static_shapes_of(product_and_twin(**MODAL, K_col_pa_m=stiffness)[0])[0]
        overlaps.append((shape.w_m - shape.medial_m).max())
    assert overlaps[0] > overlaps[1] > overlaps[2] > 0
    assert overlaps[2] < 1e-6


def test_the_edge_with_the_stiffer_coupling_follows_the_bulging_beam_more_closely():
    leads = {}
    for gradient in ("inferior_stiff", "superior_stiff"):
        shape = static_shapes_of(product_and_twin(**OPEN, coupling_gradient=gradient)[0])[0]
        middle = shape.w_m[:, fold_middle(shape)]
        leads[gradient] = abs(middle[-1]) - abs(middle[0])
    assert leads["inferior_stiff"] > 0 > leads["superior_stiff"]


def fold_middle(shape):
    return shape.w_m.shape[1] // 2


def test_a_contact_that_does_not_settle_is_an_error_with_a_remedy(monkeypatch):
    monkeypatch.setattr(vfcore.fold.statics, "MAX_ITERATIONS", 1)
    with pytest.raises(StaticShapeError, match=r"the static contact did not settle; try .*K_col_pa_m"):
        static_shapes_of(product_and_twin(**MODAL)[0])
