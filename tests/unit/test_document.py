"""Documents keep their contract: keys, plain numbers, null with a reason, strict JSON."""

import dataclasses
import json
import math

import numpy as np
import pytest

import vfcore
from vfcore.io.result_document import json_text, posture_document, result_document
from vfcore.io.stored import load_result, save_result
from vfcore.measures.measure import Measure
from vfcore.runs.one import simulate
from vfcore.runs.setup import prepare
from vfcore.spec.request import resolve
from vfcore.spec.simulation import Activation, PostureOverride, Run, Simulation

MODAL = Simulation(run=Run(duration_s=0.3))
SILENT = Simulation(activation=Activation(pca=1.0), subglottal_pressure_pa=50.0, run=Run(duration_s=0.1))


@pytest.fixture(scope="module")
def modal():
    return simulate(MODAL)


def test_posture_answers_with_the_keys_of_the_contract():
    document = posture_document(prepare(MODAL))
    assert set(document["posture"]) == {
        "strain", "glottal_half_angle_rad", "raw_glottal_half_angle_rad", "length_m", "residual", "converged",
    }  # fmt: skip
    assert set(document["coefficients"]) == {
        "membrane_tension_n_m", "beam_tension_n", "bending_stiffness_n_m2", "prestress_moment_n_m",
        "membrane_density_kg_m2", "beam_density_kg_m",
    }  # fmt: skip
    assert set(document["static_shape"]) == {
        "x_m", "superior_m", "inferior_m", "beam_m", "medial_superior_m", "medial_inferior_m", "closed_fraction",
        "closure_pattern",
    }  # fmt: skip
    assert document["null_reasons"] == {}
    # values of the paper's formulas at this posture, computed by hand
    assert document["posture"]["strain"] == pytest.approx(0.057, abs=5e-4)
    assert document["coefficients"]["membrane_tension_n_m"] == pytest.approx(7.25, rel=2e-3)
    assert document["coefficients"]["beam_tension_n"] == pytest.approx(1.86, rel=2e-3)


def test_edges_of_the_static_shape_are_superior_first():
    """With TA the inferior edge leads. The medial plane converges, so it is more lateral at the inferior edge."""
    request = Simulation(activation=Activation(lca=0.5, ia=0.5, ct=0.1, ta=0.6), convergence_angle_rad=0.05)
    prepared = prepare(request)
    shape = posture_document(prepared)["static_shape"]
    middle = len(shape["x_m"]) // 2
    assert shape["inferior_m"][middle] > shape["superior_m"][middle]
    assert shape["medial_inferior_m"][0] > shape["medial_superior_m"][0] == 0.0
    assert shape["x_m"][-1] == pytest.approx(prepared.posture.length_m)
    assert {len(shape[name]) for name in shape if name.endswith("_m")} == {request.run.nx}


def test_a_result_is_strict_json_with_the_contract_s_keys(modal):
    document = json.loads(json_text(result_document(modal)))
    assert {
        "phonation_state", "explanation", "periodicity", "measures", "posture", "coefficients", "arrays", "provenance",
    } <= set(document)  # fmt: skip
    assert document["phonation_state"] == "periodic"
    assert set(document["measures"]) == set(vfcore.CATALOGUE.keys())
    for name, array in document["arrays"].items():
        assert array["shape"] == list(modal.arrays[name].shape) and array["dtype"] == "float32"
        assert array["unit"] == vfcore.ARRAYS[name].unit and len(array["dims"]) == len(array["shape"])


def test_the_provenance_is_enough_to_run_it_again(modal):
    provenance = result_document(modal)["provenance"]
    again = simulate(resolve(json.loads(json_text(provenance["request"]))))
    assert np.array_equal(again.arrays["glottal_flow_m3_s"], modal.arrays["glottal_flow_m3_s"])
    assert provenance["time_step_s"] == pytest.approx(0.0025 / 350 * 5)


def test_missing_values_have_a_reason():
    document = result_document(simulate(SILENT))
    assert document["phonation_state"] == "none" and document["periodicity"] is None
    assert document["null_reasons"]["periodicity"] == document["explanation"]
    missing = [measure for measure in document["measures"].values() if measure["value"] is None]
    assert len(missing) > 10
    assert all(measure["reason"] for measure in missing)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_a_measure_that_is_not_finite_becomes_null_with_a_reason(modal, value):
    report = dataclasses.replace(modal.report, measures=modal.report.measures | {"fo_hz": Measure(value, "Hz")})
    document = result_document(dataclasses.replace(modal, report=report))
    assert document["measures"]["fo_hz"]["value"] is None
    assert "finite" in document["measures"]["fo_hz"]["reason"]
    assert json_text(document)


def test_any_other_number_that_is_not_finite_becomes_null_with_its_path(modal):
    broken = dataclasses.replace(modal, postures=(dataclasses.replace(modal.posture, residual=math.nan),))
    document = result_document(broken)
    assert document["posture"]["residual"] is None
    assert "finite" in document["null_reasons"]["posture.residual"]


def test_two_different_folds_are_documented_each_and_as_one():
    """The larynx as a whole has the mean posture; the fold that is shown is the left one."""
    postures = [{"strain": 0.05, "glottal_half_angle_rad": 0.01}, {"strain": 0.11, "glottal_half_angle_rad": 0.03}]
    request = resolve({"left": {"posture": postures[0]}, "right": {"posture": postures[1]}})
    document = json.loads(json_text(posture_document(prepare(request))))
    sides = document["sides"]
    for side, given in zip(("left", "right"), postures, strict=True):
        alone = posture_document(prepare(resolve({"posture": given})))
        assert "sides" not in alone
        assert sides[side]["posture"] == alone["posture"] and sides[side]["coefficients"] == alone["coefficients"]
        assert sides[side]["static_shape"]["x_m"] == alone["static_shape"]["x_m"]
    assert document["posture"]["strain"] == pytest.approx(0.08, rel=1e-12)
    gap = sum((1 + given["strain"]) * np.tan(given["glottal_half_angle_rad"]) for given in postures)
    assert document["posture"]["glottal_half_angle_rad"] == pytest.approx(np.arctan(gap / 2 / 1.08), rel=1e-12)
    assert document["coefficients"] == sides["left"]["coefficients"] != sides["right"]["coefficients"]
    assert document["static_shape"] == sides["left"]["static_shape"]


@pytest.fixture(scope="module")
def palsy():
    return simulate(resolve({"right": {"activation": {"ta": 0.1, "lca": 0.5}}, "run": {"duration_s": 0.15}}))


def test_a_run_of_two_folds_says_which_arrays_are_of_one_side(palsy):
    document = json.loads(json_text(result_document(palsy)))
    arrays = document["arrays"]
    assert (arrays["cycle_w_m"]["shape"], arrays["cycle_w_m"]["dims"]) == (
        [2, 100, 20, 10],
        ["side", "phase", "x", "y"],
    )
    assert arrays["static_wb_m"]["dims"] == ["side", "x"]
    assert arrays["cycle_contact_pressure_pa"]["dims"] == ["phase", "x", "y"], "one pressure between both"
    assert arrays["left_edge_m"]["dims"] == ["time"]
    assert (
        document["sides"]["right"]["posture"]
        == json.loads(json_text(posture_document(prepare(palsy.request))))["sides"]["right"]["posture"]
    )


def test_edges_of_both_sides_are_given_whether_or_not_the_folds_differ(modal, palsy):
    for result in (modal, palsy):
        left, right = result.arrays["cycle_edges_m"]
        w, plane = result.arrays["cycle_w_m"], result.arrays["medial_plane_m"]
        first, last = (w[0], w[1]) if w.ndim == 4 else (w, w)
        planes = plane if plane.ndim == 3 else (plane, plane)
        assert np.array_equal(left, (planes[0] - first).min(axis=-1))
        assert np.array_equal(right, -(planes[1] - last).min(axis=-1))
    assert np.array_equal(*modal.arrays["cycle_edges_m"] * np.array([1, -1])[:, None, None])


def test_gap_and_length_are_those_of_both_folds(palsy):
    left, right = palsy.postures
    openings = [one.length_m * math.tan(one.glottal_half_angle_rad) for one in (left, right)]
    assert openings[0] != openings[1]
    measures = palsy.report.measures
    assert measures["gap_mm"].value == pytest.approx(1e3 * sum(openings), rel=1e-12)
    assert measures["length_mm"].value == pytest.approx(500 * (left.length_m + right.length_m), rel=1e-12)


def test_a_stored_result_of_two_folds_reads_back_to_the_same(palsy, tmp_path):
    save_result(palsy, tmp_path / "result.npz")
    again = load_result(tmp_path / "result.npz")
    assert json_text(result_document(again)) == json_text(result_document(palsy))
    assert (again.request, again.postures, again.wall_coefficients) == (
        palsy.request, palsy.postures, palsy.wall_coefficients,
    )  # fmt: skip
    for name, array in palsy.arrays.items():
        assert np.array_equal(again.arrays[name], array, equal_nan=True), name
    for one, other in zip(again.statics, palsy.statics, strict=True):
        assert np.array_equal(one.w_m, other.w_m) and np.array_equal(one.w_b, other.w_b)


def test_a_given_posture_is_a_posture_too():
    given = Simulation(posture=PostureOverride(strain=0.2, glottal_half_angle_rad=0.004))
    posture = json.loads(json_text(posture_document(prepare(given))))["posture"]
    assert (posture["strain"], posture["glottal_half_angle_rad"]) == (0.2, 0.004)
    assert posture["length_m"] == pytest.approx(0.018) and posture["converged"] is True


def test_values_that_are_not_json_are_refused():
    with pytest.raises(ValueError):
        json_text({"value": math.nan})
