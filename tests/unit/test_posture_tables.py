"""Published sets, overrides by name, and the arrays of the kernel."""

from dataclasses import fields

import numpy as np
import pytest

from vfcore.errors import ParameterError
from vfcore.fold.constants import FoldConstants
from vfcore.kernels import posture_equations as kernel
from vfcore.larynx.posture.equilibrium import solve_posture_batch
from vfcore.larynx.posture.packing import MUSCLE_ORDER, load_scale, pack
from vfcore.spec.joints import JointConstants
from vfcore.spec.muscles import Muscle
from vfcore.spec.posture_sets import POSTURE_SETS, constant_names, posture_set


def value(constants, name):
    key, _, field_name = name.partition("_")
    if name in {spec.name for spec in fields(JointConstants)}:
        return getattr(constants, name)
    return getattr(getattr(constants, key.lower()), field_name)


def test_default_set_has_the_fold_layers_of_the_papers_table():
    c, paper = posture_set("serry2026"), FoldConstants()
    for row, layer in ((c.muc, "muc"), (c.lig, "lig"), (c.ta, "ta")):
        assert row.sigma_0_pa == getattr(paper, f"sigma_1_{layer}_pa")
        assert row.sigma_2_pa == getattr(paper, f"sigma_2_{layer}_pa")
        assert row.epsilon_1 == getattr(paper, f"epsilon_1_{layer}")
        assert row.epsilon_2 == getattr(paper, f"epsilon_2_{layer}")
        assert row.exponential_B == getattr(paper, f"alpha_1_{layer}")
        assert row.cross_section_m2 == getattr(paper, f"A_{layer}_0_m2")
    assert c.ta.sigma_max_active_pa == paper.sigma_a_max_ta_pa
    assert (c.ta.strain_at_max_active_stress, c.ta.active_width_b) == (0.4, 1.07)
    other = posture_set("alzamendi2020")
    assert (c.lca, c.ia, c.pca, c.ct) == (other.lca, other.ia, other.pca, other.ct)


def test_sets_differ_and_share_the_joints():
    sets = [posture_set(name) for name in POSTURE_SETS]
    assert len({(c.ct, c.ta, c.lig) for c in sets}) == 4
    for spec in fields(JointConstants):
        assert len({getattr(c, spec.name) for c in sets}) == 1


def test_unknown_set_is_refused():
    with pytest.raises(ParameterError) as caught:
        posture_set("titze2007")
    assert caught.value.path == "model.posture_set"
    assert "serry2026" in caught.value.allowed


def test_every_constant_is_described_and_has_the_published_value():
    for name, metadata in constant_names().items():
        assert metadata["unit"]
        assert metadata["label"]
        assert metadata["source"]
        for c in map(posture_set, POSTURE_SETS):
            assert metadata["low"] <= value(c, name) <= metadata["high"], name


@pytest.mark.parametrize("name", constant_names())
def test_every_constant_that_can_be_overridden_moves_some_posture(name):
    base = posture_set("serry2026")
    metadata, published = constant_names()[name], value(base, name)
    nearby = 1.05 * published if published else 0.01 * metadata["high"]
    changed = base.override(name, nearby if nearby <= metadata["high"] else 0.95 * published)
    loads = np.array([[0, 0, 0, 0, 0], [1, 0, 1, 1, 0], [0, 1, 0, 0, 1], [1, 1, 1, 1, 1]])
    before, after = (solve_posture_batch(loads, c).unknowns for c in (base, changed))
    assert np.nanmax(np.abs(after - before)) > 1e-9


def test_override_replaces_one_number_only():
    base = posture_set("serry2026")
    changed = base.override("TA_sigma_max_active_pa", 5e4)
    assert changed.ta.sigma_max_active_pa == 5e4
    assert base.ta.sigma_max_active_pa == 1e5
    assert changed.override("TA_sigma_max_active_pa", 1e5) == base


def test_overrides_that_are_consistent_only_together():
    changed = posture_set("serry2026").override_all({"TA_epsilon_1": -0.05, "TA_epsilon_2": 0.0})
    assert (changed.ta.epsilon_1, changed.ta.epsilon_2) == (-0.05, 0.0)


@pytest.mark.parametrize(
    ("name", "number", "path"),
    [
        ("L_0_m", 0.0173, "constants.L_0_m"),
        ("lig_rest_length_m", 0.02, "constants.lig_rest_length_m"),
        ("TA_rest_length_m", 0.02, "constants.TA_rest_length_m"),
        ("set_name", 1.0, "constants.set_name"),
        ("x_CAJ_m", 10.1, "constants.x_CAJ_m"),
        ("CT_alpha", float("nan"), "constants.CT_alpha"),
        ("CT_alpha", "0", "constants.CT_alpha"),
        ("CT_alpha", True, "constants.CT_alpha"),
        ("TA_epsilon_2", -0.6, "constants.TA_epsilon_2"),
        ("vocal_process_x_m", 0.0102, "constants.vocal_process_x_m"),
    ],
)
def test_override_that_cannot_be_used_names_the_constant(name, number, path):
    with pytest.raises(ParameterError) as caught:
        posture_set("serry2026").override(name, number)
    assert caught.value.path == path
    assert caught.value.allowed


def test_kernel_columns_and_joints_are_those_of_the_tables():
    c = posture_set("palaparthi2019")
    muscles, joints = pack(c)
    columns = ("LENGTH", "SECTION", "EPS_M", "WIDTH", "ALPHA", "BETA", "GAMMA")
    columns += ("SIGMA_0", "SIGMA_2", "EPS_1", "EPS_2", "RATE", "SIGMA_MAX")
    for row, key in enumerate((*MUSCLE_ORDER, "lig", "muc")):
        assert getattr(kernel, key.upper()) == row
        for column, spec in zip(columns, fields(Muscle), strict=True):
            assert muscles[row, getattr(kernel, column)] == getattr(getattr(c, key), spec.name)
    assert set(joints._fields) == {spec.name for spec in fields(JointConstants)}
    assert joints._asdict() == {name: getattr(c, name) for name in joints._fields}


def test_load_scale_is_the_load_of_all_muscles_and_never_zero():
    c = posture_set("serry2026")
    scale = load_scale(*pack(c))
    ct, ta = 7.38e-5 * (3e5 + 2200), 4.09e-5 * (1e5 + 2000)
    cover = 6.1e-6 * 500 + 5e-6 * 1000
    lca, ia, pca = 2.12e-5 * 1.03e5, 1.22e-5 * 1.02e5, 3.44e-5 * 1.05e5
    assert scale[0] == pytest.approx(0.198 * lca + 0.697 * ia + 0.1 * pca + 0.015 * ta)
    assert scale[1] == pytest.approx(0.886 * lca + 0.644 * ia + 0.95 * pca + 0.99 * ta)
    assert scale[2] == pytest.approx(0.003915 * lca + 0.0033 * ia + 0.00549 * pca + 0.0008 * ta)
    assert scale[3] == pytest.approx(0.76 * ct + ta + cover)
    assert scale[4] == pytest.approx(0.0111 * ct + 0.0161 * (ta + cover))
    paralysed = {name: 0.0 for name in constant_names() if "sigma" in name and name[-3:] == "_pa"}
    assert (load_scale(*pack(c.override_all(paralysed))) > 0).all()


@pytest.mark.parametrize("bad", [[0.1] * 5, [[0.1] * 4], [[0.1, 0.1, 0.1, 0.1, 1.1]], [[0.1, 0.1, float("nan"), 0, 0]]])
def test_batch_refuses_invalid_activations(bad):
    with pytest.raises(ParameterError, match="activations"):
        solve_posture_batch(bad, posture_set("serry2026"))
