"""Many simulations at once: the same numbers as one at a time, and a failure does not affect the others."""

import dataclasses

import numpy as np
import pytest

import vfcore
from vfcore.errors import Cancelled, ParameterError, StabilityError
from vfcore.fold.march_many import march_many
from vfcore.measures import CATALOGUE
from vfcore.measures.signals import unused_samples
from vfcore.runs.many import run_points, static_shapes
from vfcore.runs.one import simulate
from vfcore.spec.larynx import PAPER_LARYNX
from vfcore.spec.request import resolve

COUNTS_SAMPLES = {"contact_quotient"}  # not interpolated: rounding may move it by one sample


def _short(**changes) -> vfcore.Simulation:
    return vfcore.Simulation(run=vfcore.Run(duration_s=0.4), **changes)


HIGH = _short(activation=vfcore.Activation(ct=0.8), vowel="i")


def test_a_point_is_the_run_reduced_to_its_scalars():
    requests = [_short(), HIGH, dataclasses.replace(HIGH, run=vfcore.Run(duration_s=0.3, nx=24, start="static"))]
    for request, point in zip(requests, run_points(requests), strict=True):
        alone = vfcore.simulate(request)
        assert point.posture == alone.posture
        assert point.report.state == alone.report.state == "periodic"
        assert point.report.measures.keys() == alone.report.measures.keys()
        for key, measure in point.report.measures.items():
            expected = alone.report.measures[key]
            assert measure.reason == expected.reason
            if measure.value is not None:
                tolerance = 0.01 if key in COUNTS_SAMPLES else 1e-9
                assert measure.value == pytest.approx(expected.value, rel=tolerance, abs=0), key


@pytest.mark.parametrize("precision", ["float64", "float32"])
def test_a_point_does_not_depend_on_its_neighbours(precision):
    """Whatever vowels they have, however many there are, and whether they vibrate or not."""
    pressures = [_short(subglottal_pressure_pa=pressure) for pressure in (5.0, 700.0, 900.0, 1100.0)]
    requests = [_short(), HIGH, *pressures, dataclasses.replace(HIGH, vowel="u"), _short(vowel="i")]
    points = list(run_points(requests, precision=precision))
    assert points == [*run_points(requests[::-1], precision=precision)][::-1]
    assert points == [point for request in requests for point in run_points([request], precision=precision)]
    assert {point.report.state for point in points} == {"none", "periodic"}
    assert len({point.report.measures["spl_30cm_db"] for point in points}) == len(points)


@pytest.mark.parametrize("precision", ["float64", "float32"])
def test_a_shortened_record_changes_no_measure(precision, monkeypatch):
    """But by rounding, as instants are counted from another sample; in every state, and for tracts that ring longer."""
    postures = [vfcore.Activation(ta=0.2 * k, ct=0.1, lca=0.5, ia=0.5) for k in range(6)]
    requests = [vfcore.Simulation(activation=posture, vowel=vowel) for posture in postures for vowel in "ai"]
    left_out = []

    def counted(*given):
        left_out.append(unused_samples(*given))
        return left_out[-1]

    monkeypatch.setattr("vfcore.runs.many.unused_samples", counted)
    shortened = list(run_points(requests, precision=precision))
    assert min(left_out) > 10_000
    monkeypatch.setattr("vfcore.runs.many.unused_samples", lambda *given: 0)
    for whole, point in zip(run_points(requests, precision=precision), shortened, strict=True):
        assert point.report.state == whole.report.state
        for key, measure in whole.report.measures.items():
            value = point.report.measures[key].value
            assert value == (measure.value and pytest.approx(measure.value, rel=1e-12)), key
    assert len({point.report.state for point in shortened}) > 1


def test_a_measure_has_the_same_value_whatever_else_is_wanted():
    (whole,) = run_points([_short()])
    for key in CATALOGUE.keys():  # noqa: SIM118 - iterating gives rows
        (one,) = run_points([_short()], measures=[key])
        assert one.report.measures == {key: whole.report.measures[key]}
        assert one.report.state == whole.report.state


def test_single_precision_gives_the_same_voice():
    (double,), (single,) = run_points([_short()]), run_points([_short()], precision="float32")
    assert single.report.measures["fo_hz"].value == pytest.approx(double.report.measures["fo_hz"].value, rel=1e-3)
    assert single.report.measures != double.report.measures


def test_a_failing_point_has_its_reason_and_does_not_stop_the_others():
    too_long = dataclasses.replace(_short(), run=vfcore.Run(duration_s=0.4, time_step_s=1e-3))
    sound, broken, other = run_points([_short(), too_long, HIGH])
    assert isinstance(broken, StabilityError)
    assert sound.report.measures["mean_flow_ml_s"].value > 0
    assert other.report.measures["mean_flow_ml_s"].value > 0


@pytest.mark.parametrize("precision", ["float64", "float32"])
def test_a_flow_of_nan_does_not_change_other_points(precision, monkeypatch):
    requests = [_short(), HIGH, _short(vowel="i")]
    expected = list(run_points(requests, precision=precision))

    def spoilt(*given, **named):
        for index, outcome in march_many(*given, **named):
            if index == 1:
                outcome.flow_m3_s[-1] = np.nan
            yield index, outcome

    monkeypatch.setattr("vfcore.runs.many.march_many", spoilt)
    first, wrong, third = run_points(requests, precision=precision)
    assert [first, third] == [expected[0], expected[2]]
    assert wrong.path == "flow_m3_s"


@pytest.mark.parametrize("coupling", ["one_way", "two_way"])
def test_a_stop_ends_it(coupling):
    request = _short(model=vfcore.Model(coupling=coupling))
    with pytest.raises(Cancelled):
        list(run_points([request], stop=lambda: True))


@pytest.mark.parametrize("wrong", [{"measures": ["pitch"]}, {"precision": "float16"}])
def test_unknown_names_are_refused_by_name(wrong):
    with pytest.raises(ParameterError, match=next(iter(wrong))):
        run_points([_short()], **wrong)


def test_static_shapes_of_many_are_those_of_one():
    slack = vfcore.Simulation(
        posture=vfcore.PostureOverride(strain=-0.3), larynx=PAPER_LARYNX.override({"epsilon_1_muc": -0.2})
    )
    requests = [_short(), slack, HIGH]
    modal, failed, high = static_shapes(requests)
    with pytest.raises(ParameterError, match="no stiffness left") as refused:
        vfcore.static_shape(slack)
    assert str(failed) == str(refused.value)
    for request, found in ((requests[0], modal), (HIGH, high)):
        expected = vfcore.static_shape(request)
        assert np.array_equal(found.static.w_m, expected.w_m)
        assert found.static.closure == expected.closure


def test_a_point_with_two_way_coupling_is_the_run_itself_among_others():
    document = {"subglottal_pressure_pa": 700, "run": {"duration_s": 0.2}}
    document |= {"model": {"variant": "human", "coupling": "one_way"}}
    coupled = resolve(document | {"model": {"variant": "human"}})
    alone = simulate(coupled).report
    first, second, third = run_points([resolve(document), coupled, resolve(document)])
    (by_itself,) = run_points([coupled])
    assert second.report.measures == by_itself.report.measures  # bit for bit, whatever the others are
    assert first.report.measures == third.report.measures != second.report.measures
    assert second.report.state == alone.state == "periodic"
    for key in ("fo_hz", "mean_flow_ml_s", "spl_lips_db"):  # another order of summation
        assert second.report.measures[key].value == pytest.approx(alone.measures[key].value, rel=1e-6)
