"""Many simulations at once: the same numbers as one at a time, and one failure leaves the others alone."""

import dataclasses

import pytest

import vfcore
from vfcore.batch import run_points
from vfcore.errors import Cancelled, StabilityError


def _short(**changes) -> vfcore.Simulation:
    return vfcore.Simulation(run=vfcore.Run(duration_s=0.1), **changes)


def test_a_point_is_the_run_reduced_to_its_scalars():
    requests = [_short(), _short(activation=vfcore.Activation(ct=0.8))]
    points = list(run_points(requests))
    for request, point in zip(requests, points, strict=True):
        alone = vfcore.simulate(request)
        assert point.problem is None
        assert point.posture == alone.posture
        assert point.report.state == alone.report.state
        assert point.report.measures == alone.report.measures


def test_a_failing_point_carries_its_reason_and_stops_nobody_else():
    too_long = dataclasses.replace(_short(), run=vfcore.Run(duration_s=0.1, time_step_s=1e-3))
    broken, sound = run_points([too_long, _short()])
    assert isinstance(broken.problem, StabilityError)
    assert broken.report is None
    assert sound.report.measures["mean_flow_ml_s"].value > 0


def test_a_stop_ends_it():
    with pytest.raises(Cancelled):
        list(run_points([_short()], stop=lambda: True))
