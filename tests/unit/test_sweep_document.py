"""A sweep document: valid and refused values, and its expansion into runs."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vfcore.errors import ParameterError
from vfcore.runs.sweep import sweep_from_dict, sweep_to_dict
from vfcore.spec.paths import DECLARATIONS, NUMBERS

CT = {"parameter": "activation.ct", "values": [0, 0.5, 1]}


@pytest.mark.parametrize(
    "document, path",
    [
        ({}, "axes"),
        ({"axes": [CT], "base": {"run": {"error_estimate": True}}}, "base.run.error_estimate"),
        ({"axes": [CT], "points": [{}]}, "axes"),
        ({"axes": []}, "axes"),
        ({"axes": [CT] * 4}, "axes"),
        ({"axes": [CT, CT]}, "axes.1.parameter"),
        ({"axes": [{"parameter": "activation.ct", "values": [0, 0.5, 0.7, 2]}]}, "axes.0.values.3"),
        ({"axes": [{"parameter": "activation.ct", "values": [0, "0.5"]}]}, "axes.0.values.1"),
        ({"axes": [{"parameter": "activation.ct", "values": [float("nan")]}]}, "axes.0.values.0"),
        ({"axes": [{"parameter": "activation.ct", "values": []}]}, "axes.0.values"),
        ({"axes": [{"parameter": "activation.ctt", "values": [0]}]}, "axes.0.parameter"),
        ({"axes": [{"parameter": "vowel", "values": [0]}]}, "axes.0.parameter"),
        ({"axes": [{"parameter": ["activation.lca", "activation.xa"], "values": [0]}]}, "axes.0.parameter.1"),
        ({"axes": [{"parameter": "run.nx", "values": [20, 20.5]}]}, "axes.0.values.1"),
        ({"axes": [{"parameter": "activation.ct"}]}, "axes.0.values"),
        ({"axes": [CT | {"step": 1}]}, "axes.0.step"),
        ({"axes": ["activation.ct"]}, "axes.0"),
        ({"points": [{}, {"activation.ct": 3}]}, "points.1.activation.ct"),
        ({"points": [{"activation": {"ct": 3}}]}, "points.0.activation.ct"),
        ({"points": [7]}, "points.0"),
        ({"points": [{"run.time_step_s": None}]}, "points.0.run.time_step_s"),
        ({"axes": [{"parameter": "run.time_step_s", "values": [1e-5, None]}]}, "axes.0.values.1"),
        ({"axes": [CT], "base": {"activation": {"ta": 2}}}, "base.activation.ta"),
        ({"axes": [CT], "base": []}, "base"),
        ({"axes": [CT], "measures": ["fo_hz", "f0"]}, "measures.1"),
        ({"axes": [CT], "measures": []}, "measures"),
        ({"axes": [CT], "precision": "float16"}, "precision"),
        ({"axes": [CT], "keep_waveforms": 1}, "keep_waveforms"),
        ({"axes": [CT], "keep": 1}, "keep"),
        ({"axes": [CT], "kind": "simulation"}, "kind"),
        ({"axes": [CT], "keep_waveforms": True, "precision": "float32"}, "precision"),
        ({"points": [{}] * 501, "keep_waveforms": True}, "keep_waveforms"),
    ],
)
def test_a_bad_field_is_named_by_its_dotted_path(document, path):
    with pytest.raises(ParameterError) as refusal:
        sweep_from_dict(document)
    assert refusal.value.path == path
    assert refusal.value.allowed


def test_axes_unfold_in_c_order_and_tied_parameters_vary_jointly():
    tied = {"parameter": ["activation.lca", "activation.ia"], "values": [0.2, 0.9]}
    sweep = sweep_from_dict({"axes": [CT, tied]})
    assert sweep.shape == (3, 2) and len(sweep) == 6
    runs = [request.activation for request in sweep.requests()]
    assert [(run.ct, run.lca, run.ia) for run in runs] == [
        (ct, adduction, adduction) for ct in (0, 0.5, 1) for adduction in (0.2, 0.9)
    ]


def test_equal_sweeps_are_equal_documents():
    one = sweep_from_dict({"axes": [CT], "measures": ["spl_lips_db", "fo_hz"]})
    axes = [CT | {"values": [0.0, 0.5, 1.0]}]
    document = {"kind": "sweep", "base": {"vowel": "a"}, "axes": axes, "measures": ["fo_hz", "spl_lips_db"]}
    other = sweep_from_dict(document)
    assert sweep_to_dict(one) == sweep_to_dict(other)
    assert sweep_from_dict(sweep_to_dict(one)) == one


def values_of(path: str):
    row = DECLARATIONS[path]
    low, high = row.metadata["low"], row.metadata["high"]
    return st.integers(low, high) if row.is_whole else st.floats(low, high) | st.just(row.default or low)


overrides = st.lists(st.sampled_from(NUMBERS), min_size=1, max_size=4, unique=True).flatmap(
    lambda paths: st.fixed_dictionaries({path: values_of(path) for path in paths})
)


@given(overrides)
def test_overlapping_sweeps_share_addresses(point):
    alone = sweep_from_dict({"points": [point]})
    among = sweep_from_dict({"points": [{"activation.ct": 0.123}, point]})
    assert alone.address(0) == among.address(1) == among.part([1]).address(0)


def test_a_point_has_the_values_of_the_base_unless_it_sets_them():
    sweep = sweep_from_dict({"base": {"activation": {"ct": 0.7}}, "points": [{}, {"activation.ct": 0.7}]})
    assert sweep.address(0) == sweep.address(1)


def test_a_different_question_has_a_different_address():
    asked = [{}, {"precision": "float32"}, {"measures": ["fo_hz"]}]
    addresses = {sweep_from_dict({"points": [{}]} | extra).address(0) for extra in asked}
    assert len(addresses) == 3
